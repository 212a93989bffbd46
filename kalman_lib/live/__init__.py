"""What explorer.py and exercises.py need beside themselves: still pictures, the reader's files, the
grading, the bundle."""
