"""What explorer.py needs beside its widget: still pictures, the reader's files, the bundle."""
