"""The live worker: drawings, lights and looks come in over ZeroMQ, lit pictures go out."""
