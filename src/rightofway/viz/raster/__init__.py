"""A plan as a picture (PNG) or a short film (GIF), in the colours of the page."""

from rightofway.viz.raster.film import Film, write_gif
from rightofway.viz.raster.picture import write_png

__all__ = ["Film", "write_gif", "write_png"]
