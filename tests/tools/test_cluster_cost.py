# SPDX-License-Identifier: MIT
"""The model of tools/cluster_cost.py beside its simulation, and both where the answer is known."""

import dataclasses
import sys

import budgets
import pytest


@pytest.fixture(scope="module")
def cost(root):
    sys.path.insert(0, str(root / "tools"))
    import cluster_cost
    yield cluster_cost
    sys.path.pop(0)


@pytest.fixture
def free(cost):
    """A cluster of which the leader has nothing to pay."""
    return lambda ranks, threads=1: cost.Cluster(ranks, threads, message=0, number=0, column=0,
                                                 cell=0, written=0, byte=0, rest=0)


@pytest.mark.parametrize("ranks, threads", [(1, 1), (2, 1), (4, 1), (3, 4), (100, 1)])
def test_work_that_costs_the_leader_nothing_is_shared_evenly(cost, free, ranks, threads):
    ensemble = cost.Ensemble(1200, 0.5, 1, scatter=0.0, rows=10, columns=0)
    found = cost.simulate(ensemble, free(ranks, threads))
    assert found["total"] - cost.before(ensemble, free(ranks)) == pytest.approx(
        600 / (ranks * threads), rel=budgets.cluster_even)


def test_a_chunk_more_than_ranks_takes_a_round_more(cost, free):
    ensemble = cost.Ensemble(11, 2.0, 1, scatter=0.0, rows=1, columns=0)
    assert cost.simulate(ensemble, free(10))["total"] == 2.0 + 4.0  # the file itself first
    assert cost.model(ensemble, free(10))["total"] == 6.0


def test_a_leader_that_is_slow_bounds_all(cost, free):
    ensemble = cost.Ensemble(10000, 1e-3, 10, scatter=0.1, rows=10, columns=2)
    cluster = dataclasses.replace(free(50), number=0.01 / ensemble.numbers)  # as long as a chunk
    found, slow = cost.model(ensemble, cluster), cost.simulate(ensemble, cluster)
    assert cost.ranks_of_use(ensemble, cluster) == pytest.approx(1)
    assert found["bound"] == "leader"
    before = cost.before(ensemble, cluster)
    assert slow["total"] - before == pytest.approx(10.0, rel=budgets.cluster_bound)
    assert found["total"] == pytest.approx(slow["total"], rel=budgets.cluster_bound)
    assert slow["busy"] > 1 - budgets.cluster_bound
    # Memory has an end.
    assert slow["waiting"] == pytest.approx(cost.WAITING * 50, rel=budgets.cluster_waiting)


@pytest.mark.parametrize("ranks", [2, 10, 100, 1000])
@pytest.mark.parametrize("seconds, rows, chunk", [(0.001, 100, 5), (0.1, 1000, 5), (0.1, 10, 2)])
def test_model_and_simulation_agree(cost, ranks, seconds, rows, chunk):
    ensemble = cost.Ensemble(20000, seconds, chunk, rows=rows)
    found, slow = (way(ensemble, cost.Cluster(ranks)) for way in (cost.model, cost.simulate))
    assert found["total"] == pytest.approx(slow["total"], rel=budgets.cluster_model)


def test_a_slow_chunk_holds_up_the_others_but_not_for_long(cost, free):
    alike, scattered = (cost.simulate(cost.Ensemble(4000, 0.1, 1, scatter=scatter, rows=1,
                                                    columns=0), free(20))["total"]
                        for scatter in (0.0, 0.5))
    assert alike < scattered < (1 + budgets.cluster_scatter) * alike


def test_counts_are_those_of_normal_numbers(cost):
    """By drawing them."""
    import numpy as np
    random = np.random.default_rng(1)
    edges = np.linspace(-6.5, 6.5, 257)
    for members in (16, 128, 1000):
        found = []
        for _ in range(200):
            full = np.pad(np.histogram(random.normal(size=members), edges)[0] > 0, 1)
            runs = 1 + (full[1:] & ~full[:-1]).sum()  # of empty ones
            found.append(full.sum() + runs)
        assert cost.counts(members, 256) == pytest.approx(np.mean(found),
                                                          rel=budgets.cluster_counts)


def test_sizes_are_those_of_the_benchmark(cost):
    """Numbers of a chunk as benchmarks/ensemble_chunks.cpp prints them, and what they cost."""
    of = dict(chunk=128, seconds=1.0)
    assert cost.Ensemble(512, rows=10, **of).numbers == 8790
    assert cost.Ensemble(512, rows=1000, **of).numbers == 853260
    assert cost.Ensemble(10 ** 8, rows=1000, columns=0, attitudes=1, **of).numbers == 25260
    of_bins = cost.Ensemble(10 ** 8, rows=1000, **of)
    assert of_bins.numbers == pytest.approx(504266, rel=budgets.cluster_size)
    assert cost.merge(of_bins, cost.Cluster(1)) == pytest.approx(12.4e-3, rel=budgets.cluster_merge)


def test_a_table_for_those_that_are_not_refused(root, capsys, monkeypatch, cost):
    monkeypatch.setattr(sys, "argv", ["cluster_cost.py", "--members", "1000", "--seconds", "0.1",
                                      "--chunk", "10", "--ranks", "10", "101", "--simulate"])
    cost.main()
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 3 and len({line.count("|") for line in lines}) == 1
