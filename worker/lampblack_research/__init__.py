"""How the networks of ``lampblack`` are made: data sets, training and evaluation.

Lighting drawings does not need it, and nothing in ``lampblack`` imports it. It adds the commands
``dataset build``, ``train``, ``evaluate`` and ``flicker``.
"""
