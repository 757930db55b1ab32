"""Rendering on many machines: job templates for render farms, and clusters.

Both distribute the same tasks. A task has whole drawings, so that each drawing is lit once. A task
can be run again at any time.
"""
