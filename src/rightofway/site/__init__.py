"""The place that robots drive in: roadmap, zones, walls, lanes and their pieces, places by name."""

from rightofway.site.clustering import (
    Floor,
    Obstacle,
    cluster,
    compute_node_length,
    compute_steps_per_unit,
)
from rightofway.site.edges import Edge, make_roadmap
from rightofway.site.geometry import (
    Frame,
    Point,
    VertexId,
    choose_rounding_step,
    measure_squared_distance,
    measure_straight_length,
)
from rightofway.site.grid import make_grid_roadmap
from rightofway.site.roadmap import EdgeClass, Grid, Lane, Roadmap

__all__ = [
    "Edge",
    "EdgeClass",
    "Floor",
    "Frame",
    "Grid",
    "Lane",
    "Obstacle",
    "Point",
    "Roadmap",
    "VertexId",
    "choose_rounding_step",
    "cluster",
    "compute_node_length",
    "compute_steps_per_unit",
    "make_grid_roadmap",
    "make_roadmap",
    "measure_squared_distance",
    "measure_straight_length",
]
