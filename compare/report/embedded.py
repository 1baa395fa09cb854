"""Pictures inside a page."""

import base64


def encoded(content):
    """The bytes of a picture as the text of a data: address."""
    return base64.b64encode(content).decode("ascii")
