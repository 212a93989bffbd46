"""What explorer.py needs beside its widget: still pictures, what the kernel reads and writes for the reader, the bundle."""
