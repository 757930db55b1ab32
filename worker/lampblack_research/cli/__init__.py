"""The commands that research adds; ``lampblack.cli.app`` loads one when it is called."""
