"""What stands behind montecarlo.py: nobody needs to read it to make a study.

arguments.py  what is refused
blocks.py     what a worker does: a block of runs
workers.py    who does it, and what remains if the work stops
"""
