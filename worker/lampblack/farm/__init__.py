"""More than one machine: job templates for render farms, and clusters.

Both spread the same work: tasks of whole drawings, so that each is lit once wherever it is held,
and each task may be run again at will.
"""
