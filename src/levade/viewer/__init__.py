"""Pages that levade serves: a solve as it goes on, a robot, a task or a motion to look at."""
