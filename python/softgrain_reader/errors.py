"""The one exception of this package."""


class RunError(Exception):
    """A run, or a part of it, that cannot be read: the message names the file and the cure."""
