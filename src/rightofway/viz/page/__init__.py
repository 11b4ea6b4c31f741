"""A plan as one HTML file that plays it: no network, no server, nothing to install."""

from rightofway.viz.page.document import frame_of, page_of, write_page
from rightofway.viz.page.payload import payload_of

__all__ = ["frame_of", "page_of", "payload_of", "write_page"]
