"""How the networks of ``lampblack`` came to be: data sets, training and evaluation.

Whoever lights drawings needs none of it, and nothing in ``lampblack`` imports it; it adds the
commands ``dataset build``, ``train``, ``evaluate`` and ``flicker``.
"""
