"""Pages that levade serves: a running solve, a robot, a task or a motion."""
