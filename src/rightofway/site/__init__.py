"""The place that robots drive in: roadmap, zones, walls, lanes and their pieces, places by name."""

from rightofway.site.clustering import (
    Floor,
    Obstacle,
    cluster,
    compute_node_length,
    compute_steps_per_unit,
)
from rightofway.site.edges import Edge, roadmap_of_edges
from rightofway.site.geometry import (
    Frame,
    Point,
    VertexId,
    choose_rounding_step,
    measure_straight_length,
    squared_distance,
)
from rightofway.site.grid import roadmap_of_grid
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
    "measure_straight_length",
    "roadmap_of_edges",
    "roadmap_of_grid",
    "squared_distance",
]
