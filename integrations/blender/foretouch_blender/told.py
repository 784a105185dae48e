"""What a user is told, in Blender's words, in place of an answer."""


class Told(Exception):
    """Why there is no answer. The operators report its text as an error."""
