"""The live worker: receives drawings, scenes and viewports over ZeroMQ, and sends lit pictures."""
