"""What people look at: figures, videos and pages, made from motion files."""
