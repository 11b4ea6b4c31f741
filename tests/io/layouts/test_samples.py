"""Real layouts of other projects open, and are as large as their sources say."""

from __future__ import annotations

from pathlib import Path

import pytest

from rightofway.io.layouts import describe_layout, is_layout, read_layout

SAMPLES = Path(__file__).parents[2] / "data" / "samples"

SIZES = {  # by glob
    "lif/example_10_10_*.lif.json": "a LIF layout with 6 vertices, 6 lanes and 1 station",
    "lif/example_10_11_*.lif.json": "a LIF layout with 5 vertices and 8 lanes",
    "lif/example_10_12_*.lif.json": "a LIF layout with 3 vertices and 3 lanes",
    "lif/example_10_13_*.lif.json": "a LIF layout with 2 vertices, 2 lanes and 1 station",
    "lif/example_10_14_*.lif.json": "a LIF layout with 2 levels, 4 vertices and 3 lanes",
    "lif/example_10_15_*.lif.json": "a LIF layout with 2 vertices, 2 lanes and 3 stations",
    "lif/example_10_16_*.lif.json": "a LIF layout with 4 vertices, 6 lanes and 3 stations",
    "lif/example_10_17_*.lif.json": "a LIF layout with 2 vertices and 2 lanes",
    "lif/example_10_18_*.lif.json": "a LIF layout with 2 vertices and 2 lanes",
    "lif/example_10_1_*.lif.json": "a LIF layout with 2 vertices and 1 lane",
    "lif/example_10_2_*.lif.json": "a LIF layout with 2 vertices and 2 lanes",
    "lif/example_10_3_*.lif.json": "a LIF layout with 2 vertices and 2 lanes",
    "lif/example_10_4_*.lif.json": "a LIF layout with 2 vertices and 2 lanes",
    "lif/example_10_5_*.lif.json": "a LIF layout with 2 levels, 4 vertices and 2 lanes",
    "lif/example_10_6_*.lif.json": "a LIF layout with 2 vertices, 2 lanes and 1 station",
    "lif/example_10_7_*.lif.json": "a LIF layout with 5 vertices, 6 lanes and 1 station",
    "lif/example_10_8_*.lif.json": "a LIF layout with 4 vertices, 4 lanes and 1 station",
    "lif/example_10_9_*.lif.json": "a LIF layout with 4 vertices, 3 lanes and 1 station",
    "movingai/random-32-32-20.map": "a MovingAI map of 32 x 32 cells",
    "nav2/aws_graph.geojson": "a Nav2 route graph with 40 vertices and 83 lanes",
    "nav2/depot_graph.geojson": "a Nav2 route graph with 34 vertices and 78 lanes",
    "nav2/sample_graph.geojson": "a Nav2 route graph with 9 vertices and 24 lanes",
    "nav2/turtlebot3_graph.geojson": "a Nav2 route graph with 20 vertices and 65 lanes",
    "nav2/warehouse_graph.geojson": "a Nav2 route graph with 96 vertices and 172 lanes",
    "open_rmf/battle_royale.building.yaml": "an Open-RMF building with 21 vertices and 40 lanes",
    "open_rmf/office.building.yaml": "an Open-RMF building with 29 vertices and 60 lanes",
    "open_rmf/triple_H.building.yaml": "an Open-RMF building with 23 vertices and 44 lanes",
    "opentcs/Demo-01.xml": "an openTCS plant model with 59 vertices, 75 lanes and 15 stations",
    "opentcs/PlantModelV005.*": "an openTCS plant model with 15 vertices, 6 lanes and 1 station",
    "opentcs/PlantModelV6.*": "an openTCS plant model with 15 vertices, 6 lanes and 1 station",
    "opentcs/PlantModelV7.*": "an openTCS plant model with 15 vertices, 6 lanes and 1 station",
    "ros_map/depot.yaml": "a ROS map of 604 x 307 pixels",
    "ros_map/tb3_sandbox.yaml": "a ROS map of 384 x 384 pixels",
}


@pytest.mark.parametrize("name", SIZES)
def test_a_real_layout_opens(name: str) -> None:
    (path,) = SAMPLES.glob(name)
    assert is_layout(path)
    assert str(describe_layout(read_layout(path))) == SIZES[name]
