"""Relations found in small pictures with known contacts."""

from __future__ import annotations

import networkx as nx
import numpy as np
import pytest
from engine_support import disc, picture, rect, relations

PAIR = ("Lamp:Shade", "Lamp:Foot")


def stacked(gap, names=PAIR, size=128):
    """A 40 x 20 box at (40, 20), below it a 16 wide one after `gap` empty rows; all in proportion to the size."""
    u = size / 128
    return picture(
        {
            names[0]: rect(40 * u, 20 * u, 80 * u, 40 * u),
            names[1]: rect(52 * u, 40 * u + gap, 68 * u, 80 * u),
        },
        size,
    )


def test_touching_segments_are_connected_without_a_gap():
    found = relations(stacked(0))
    assert set(found) == {PAIR}
    assert found[PAIR].kind == "overlap"
    assert found[PAIR].contact.gap == 0


def test_parts_of_one_object_are_connected_across_a_thin_gap():
    relation = relations(stacked(4))[PAIR]
    assert (relation.kind, relation.contact.gap) == ("overlap", 4)


def test_a_wide_gap_is_not_bridged():
    assert relations(stacked(12))[PAIR].kind == "near"


def test_what_counts_as_a_thin_gap_grows_with_the_picture():
    assert relations(stacked(5, size=64))[PAIR].kind == "near"
    assert relations(stacked(5, size=128))[PAIR].kind == "overlap"


def connected(scene):
    """The pairs that are joined, not just near each other."""
    return {p for p, r in relations(scene).items() if r.kind != "near"}


def test_a_thin_gap_between_objects_separates_them():
    assert not connected(stacked(4, ("Lamp", "Table")))
    assert connected(stacked(0, ("Lamp", "Table")))


def test_objects_that_nearly_touch_are_connected_in_proportion_to_the_picture():
    assert not connected(stacked(2, ("Lamp", "Table"), size=128))
    assert connected(stacked(2, ("Lamp", "Table"), size=256))


def test_a_contact_is_blocked_by_a_segment_that_lies_between():
    ends = {"Train:Front": rect(20, 40, 50, 80), "Train:Back": rect(55, 40, 85, 80)}
    assert ("Train:Front", "Train:Back") in relations(picture(ends))
    found = relations(picture(ends | {"Train:Joint": rect(51, 30, 54, 90)}))
    assert set(found) == {("Train:Front", "Train:Joint"), ("Train:Back", "Train:Joint")}


def test_a_contact_has_its_middle_its_ends_and_its_direction():
    contact = relations(stacked(4))[PAIR].contact
    above, below = contact.middle
    assert np.allclose(above, [60, 39.5], atol=0.2) and np.allclose(below, [60, 44.5], atol=0.2)
    assert np.allclose(contact.normal, [0, 1])
    ends = sorted([contact.first[:, 0].mean(), contact.second[:, 0].mean()])
    assert ends[0] == pytest.approx(52.5, abs=1.5) and ends[1] == pytest.approx(67.5, abs=1.5)
    assert contact.length == pytest.approx(16, abs=4)


def test_the_normal_points_from_the_first_to_the_second():
    upside_down = {"Lamp:Foot": rect(52, 44, 68, 80), "Lamp:Shade": rect(40, 20, 80, 40)}
    contact = relations(picture(upside_down))[PAIR[::-1]].contact
    assert np.allclose(contact.normal, [0, -1])
    assert contact.middle[0, 1] > contact.middle[1, 1]


def test_shares_tell_how_much_of_each_outline_lies_at_the_contact():
    contact = relations(stacked(0))[PAIR].contact
    assert contact.share == pytest.approx(16 / 120, abs=0.03)
    assert contact.share_b == pytest.approx(16 / 112, abs=0.03)
    assert contact.share < contact.share_b


def test_a_thing_in_a_holder_meets_it_where_it_rests_not_at_its_flanks():
    holder = [rect(30, 70, 40, 100), rect(60, 70, 70, 100), rect(30, 90, 70, 100)]
    contact = relations(picture({"Cup:Pencil": rect(40, 20, 60, 90), "Cup:Holder": holder}))[
        ("Cup:Pencil", "Cup:Holder")
    ].contact
    assert np.allclose(contact.middle.mean(0), [50, 90], atol=1)
    assert abs(contact.normal[1]) > 0.99
    assert np.ptp([contact.first[:, 0].mean(), contact.second[:, 0].mean()]) > 15


def test_what_lies_in_a_hole_is_inside_and_joined_at_its_own_centre():
    ring = {"Target:Ring": disc(64, 64, 40), "hole": disc(64, 64, 25), "Target:Dot": disc(70, 60, 9)}
    scene = picture(ring)
    found = relations(scene)
    relation = found[("Target:Dot", "Target:Ring")]
    assert relation.kind == "inside" and relation.embedded
    assert np.allclose(relation.contact.middle, [[70, 60], [70, 60]], atol=0.01)


@pytest.mark.parametrize("detail_first", [True, False])
def test_what_is_let_into_an_edge_is_a_detail_of_its_host(detail_first):
    shapes = {
        "House:Window": rect(56, 30, 72, 46),
        "House:Wall": [rect(30, 30, 56, 100), rect(72, 30, 98, 100)],
    }
    shapes["House:Wall"].append(rect(30, 46, 98, 100))
    order = shapes if detail_first else dict(reversed(shapes.items()))
    found = relations(picture(order))
    relation = found[("House:Window", "House:Wall")]
    assert (relation.kind, relation.embedded) == ("inside", True)
    assert relation.contact.middle[0, 1] == pytest.approx(45.5, abs=0.4)  # its own lower edge
    assert relation.contact.middle[1, 1] == pytest.approx(46.5, abs=0.4)


def test_what_only_stands_on_its_neighbour_is_no_detail():
    found = relations(picture({"House:Roof": rect(40, 20, 90, 46), "House:Wall": rect(30, 46, 98, 100)}))
    assert not found[("House:Roof", "House:Wall")].embedded


def test_relations_between_objects_have_their_own_scope():
    scene = picture(
        {"Cup": rect(40, 30, 70, 60), "Table:Top": rect(20, 60, 110, 70), "Table:Leg": rect(60, 70, 68, 110)}
    )
    scopes = {names: r.scope for names, r in relations(scene).items()}
    assert scopes == {("Cup", "Table:Top"): "inter", ("Table:Top", "Table:Leg"): "intra-crucial"}


def test_the_widest_gap_of_a_ring_is_not_crucial():
    parts = {
        "Frame:Top Left": rect(20, 20, 60, 60),
        "Frame:Top Right": rect(62, 20, 102, 60),
        "Frame:Bottom Left": rect(20, 62, 60, 102),
        "Frame:Bottom Right": rect(66, 62, 102, 102),
    }
    scopes = {names: r.scope for names, r in relations(picture(parts)).items()}
    assert scopes[("Frame:Bottom Left", "Frame:Bottom Right")] == "intra"
    tight = [k for k in scopes if k in {("Frame:Top Left", "Frame:Top Right"), ("Frame:Top Left", "Frame:Bottom Left")}]
    assert len(tight) == 2 and all(scopes[k] == "intra-crucial" for k in tight)


@pytest.mark.parametrize("seed", range(4))
def test_crucial_and_near_relations_hold_every_object_together(seed):
    random = np.random.default_rng(seed)
    cells = random.permutation(16)[:8]
    shapes = {}
    for k, cell in enumerate(cells):
        x, y = 8 + 30 * (cell % 4), 8 + 30 * (cell // 4)
        w, h = random.integers(12, 31, 2)
        shapes[f"{'AB'[k % 2]}:Part {k}"] = rect(x, y, x + w, y + h)
    scene = picture(shapes)
    found = relations(scene)
    for thing in scene.objects:
        graph = nx.Graph()
        graph.add_nodes_from(scene.names[i] for i in scene.members(thing))
        firm = [p for p, r in found.items() if r.scope == "intra-crucial" or r.kind == "near"]
        graph.add_edges_from(p for p in firm if p[0] in graph and p[1] in graph)
        assert nx.is_connected(graph)


def test_near_relations_tie_far_parts_over_the_shortest_gaps_and_no_more():
    scene = picture({"Dots:A": disc(15, 64, 8), "Dots:C": disc(110, 64, 8), "Dots:B": disc(60, 64, 8)})
    found = relations(scene)
    assert {frozenset(p) for p in found} == {frozenset({"Dots:A", "Dots:B"}), frozenset({"Dots:B", "Dots:C"})}
    assert all(r.kind == "near" and r.scope != "inter" for r in found.values())


def test_objects_far_apart_are_not_related():
    assert not relations(picture({"Left": disc(15, 64, 8), "Right": disc(60, 64, 8)}))


def test_a_pair_has_at_most_one_relation_and_none_with_itself():
    shapes = {
        f"Wall:Brick {k}": rect(10 + 25 * (k % 4), 20 + 20 * (k // 4), 35 + 25 * (k % 4), 40 + 20 * (k // 4))
        for k in range(12)
    }
    scene = picture(shapes)
    pairs = [frozenset(p) for p in relations(scene)]
    assert len(pairs) == len(set(pairs)) and all(len(p) == 2 for p in pairs)
