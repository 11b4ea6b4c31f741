"""A plan as a picture (PNG) or a short film (GIF), in the colours of the page."""

from rightofway.viz.raster.picture import Film, write_gif, write_png

__all__ = ["Film", "write_gif", "write_png"]
