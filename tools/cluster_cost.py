#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How long an ensemble takes on many processes, and what bounds it: a model of what
`mpirun polhode ensemble` does (src/mpi), and a simulation of it chunk by chunk.

    tools/cluster_cost.py --members 1000000 --seconds 1 --rows 1000 --columns 6 --chunk 20

The constants are those of benchmarks/ensemble_chunks.cpp on an Intel Emerald Rapids core, in
processor time. What it says of thousands of processes nobody has measured: docs/guide/clusters.md
says where that breaks.
"""

import argparse
import dataclasses
import heapq
import math
import random

# Members that a process runs at a time, and the most of them that go first to fix bins and
# references (src/run/ensemble).
LANES, PILOTS, PILOTS_OF_ATTITUDES, EXACT = 16, 1024, 64, 8e6
# Chunks that wait for an earlier one: so many for each thread (src/mpi/leader.cpp).
WAITING = 4


@dataclasses.dataclass(frozen=True)
class Ensemble:
    """Statistics of members that take `seconds` each; `scatter`: how much a chunk's time varies."""

    members: int
    seconds: float
    chunk: int
    rows: int = 1000
    columns: int = 6
    attitudes: int = 0
    bins: int = 256
    keys: int = 1
    scatter: float = 0.05

    @property
    def chunks(self):
        return -(-self.members // self.chunk)

    @property
    def is_exact(self):
        return self.members * self.rows * max(self.columns, 1) <= EXACT

    @property
    def numbers(self):
        """Of a chunk, eight bytes each: what was drawn, counts, and accumulators."""
        held = self.chunk if self.is_exact else counts(self.chunk, self.bins)
        each = 1 + 24 * self.attitudes + self.columns * (14 + held)
        return 4 + self.chunk * (self.keys + 1) + self.rows * each

    @property
    def state(self):
        """The numbers of a checkpoint, at most."""
        held = self.members if self.is_exact else counts(self.members, self.bins)
        return self.rows * (1 + 24 * self.attitudes + self.columns * (14 + held))

    @property
    def pilots(self):
        if self.is_exact and not self.attitudes:
            return 0
        most = PILOTS_OF_ATTITUDES if self.is_exact else PILOTS
        return min(max(self.members // 8, 1), most)


@dataclasses.dataclass(frozen=True)
class Cluster:
    """Ranks of so many threads, and what the leader pays, in seconds."""

    ranks: int
    threads: int = 1
    start: float = 0.0  # until all ranks have read the file
    message: float = 20e-6  # to hand out a chunk, or to take one from the network
    number: float = 11e-9  # to read
    column: float = 300e-9  # to merge a column of a row,
    cell: float = 3.5e-9  # and each of its bins, full or not: they wait for memory
    written: float = 15e-9  # a number of a checkpoint
    byte: float = 3e-10  # on the network, and out of it
    rest: float = 1e-3  # a process without news sleeps up to so long
    every: float = 5.0  # between two checkpoints, which take a twentieth of the time at most

    @property
    def workers(self):
        return self.ranks * self.threads


def counts(members, bins):
    """How many numbers tell the counts of so many normal numbers: one for each bin that has some,
    one for each run of empty ones. Bins cover twice the range of a thousand, 6.5 deviations."""
    width = 13.0 / bins
    edge = [0.5 * math.erfc((6.5 - k * width) / math.sqrt(2)) for k in range(bins + 1)]
    empty = [1.0, *((1.0 - (b - a)) ** members for a, b in zip(edge, edge[1:], strict=False)), 1.0]
    full = bins + 2 - sum(empty)
    return full + 1 + sum(a * (1.0 - b) for a, b in zip(empty, empty[1:], strict=False))


def merge(ensemble, cluster):
    """What the leader does with the bytes of a chunk."""
    bins = 0 if ensemble.is_exact else ensemble.bins
    return ensemble.numbers * cluster.number + ensemble.rows * ensemble.columns * (
        cluster.column + bins * cluster.cell)


def take(ensemble, cluster):
    """With what goes before: handing it out, and receiving it."""
    received = 8 * cluster.byte * ensemble.numbers
    return 2 * cluster.message + received + merge(ensemble, cluster)


def checkpoint(ensemble, cluster):
    return ensemble.state * cluster.written


def ranks_of_use(ensemble, cluster):
    """How many threads the leader can keep at work."""
    return ensemble.chunk * ensemble.seconds / take(ensemble, cluster)


def before(ensemble, cluster):
    """The file itself, then the first members, sixteen at a time."""
    if not ensemble.pilots:
        return ensemble.seconds
    rounds = math.ceil(math.ceil(ensemble.pilots / LANES) / cluster.workers)
    return ensemble.seconds * (1 + rounds * min(LANES, ensemble.pilots))


def model(ensemble, cluster):
    """start + first members + max(compute, leader), each in seconds, and what bounds it."""
    each = ensemble.chunk * ensemble.seconds
    rounds = ensemble.chunks / cluster.workers
    # Whole rounds if chunks are alike; else whoever is free takes the next, and the last one ends
    # half a chunk after the others on average.
    even = math.ceil(rounds) if rounds < 2 else max(rounds + 0.5, math.ceil(rounds))
    compute = even * each + take(ensemble, cluster)
    share = min(checkpoint(ensemble, cluster) / cluster.every, 0.05)
    leader = each + ensemble.chunks * take(ensemble, cluster) * (1 + share)
    total = cluster.start + before(ensemble, cluster) + max(compute, leader)
    return {"total": total, "compute": compute, "leader": leader,
            "bound": "leader" if leader > compute else "members",
            "efficiency": ensemble.members * ensemble.seconds / (total * cluster.workers)}


def woken(asleep, arrival, rest):
    """When a process looks that fell asleep then, for 20 us at first, twice as long each time."""
    if not rest:
        return max(asleep, arrival)
    pause = 20e-6
    while asleep < arrival:
        if pause >= rest:
            return asleep + rest * math.ceil((arrival - asleep) / rest)
        asleep, pause = asleep + pause, min(2 * pause, rest)
    return asleep


class Ranks:
    """When the chunks that are handed out come back."""

    def __init__(self, ensemble, cluster, draw):
        self.cluster, self.draw = cluster, draw
        self.bytes = 8 * ensemble.numbers * cluster.byte
        self.free = [[0.0] * cluster.threads for _ in range(cluster.ranks)]
        self.arrivals = []

    def add(self, now, rank, chunk):
        begin = max(now, heapq.heappop(self.free[rank]))
        end = begin + self.draw()
        heapq.heappush(self.free[rank], end)
        heapq.heappush(self.arrivals,
                       (woken(begin, end, self.cluster.rest) + self.bytes, rank, chunk))


def simulate(ensemble, cluster, seed=1):
    """The same by the loop of src/mpi/leader.cpp; and how many chunks waited at a time."""
    random_ = random.Random(seed)
    each, spread = ensemble.chunk * ensemble.seconds, ensemble.scatter
    shape = math.sqrt(math.log1p(spread ** 2))
    ranks = Ranks(ensemble, cluster,
                  lambda: each * random_.lognormvariate(-shape ** 2 / 2, shape))
    cost, pause = merge(ensemble, cluster), max(cluster.every, 20 * checkpoint(ensemble, cluster))
    now = cluster.start + before(ensemble, cluster)
    next_, taken, most, busy, kept = 0, 0, 0, 0.0, now
    under_way, waiting = [0] * cluster.ranks, set()
    hungry = [(0, rank) for rank in range(cluster.ranks)]
    while taken < ensemble.chunks:
        begin, found = now, False
        limit = min(ensemble.chunks, taken + WAITING * cluster.workers)
        while hungry and next_ < limit:
            under, rank = heapq.heappop(hungry)
            if under != under_way[rank]:
                continue
            found = True
            now += cluster.message
            ranks.add(now, rank, next_)
            next_ += 1
            under_way[rank] += 1
            if under_way[rank] <= cluster.threads:
                heapq.heappush(hungry, (under_way[rank], rank))
        while ranks.arrivals and ranks.arrivals[0][0] <= now:
            found = True
            _, rank, chunk = heapq.heappop(ranks.arrivals)
            now += cluster.message + ranks.bytes
            under_way[rank] -= 1
            heapq.heappush(hungry, (under_way[rank], rank))
            waiting.add(chunk)
        most = max(most, len(waiting))
        if taken in waiting:
            found = True
            waiting.remove(taken)
            now += cost
            taken += 1
            if now - kept >= pause:
                now += checkpoint(ensemble, cluster)
                kept = now
        busy += now - begin
        if not found:
            now = woken(now, ranks.arrivals[0][0], cluster.rest)
    return {"total": now, "busy": busy / now, "waiting": most}


def line(ensemble, cluster, by_chunks):
    found = model(ensemble, cluster)
    size = 8 * ensemble.numbers
    yield from (cluster.ranks, ensemble.chunk, f"{1e-6 * size:.2g}", f"{found['total']:.3g}")
    if by_chunks:
        slow = simulate(ensemble, cluster)
        yield from (f"{slow['total']:.3g}", f"{1e-9 * slow['waiting'] * size:.2g}")
    yield from (f"{100 * found['efficiency']:.0f}", found["bound"],
                f"{ranks_of_use(ensemble, cluster):.2g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--members", type=int, required=True)
    parser.add_argument("--seconds", type=float, required=True, help="processor time of a member")
    parser.add_argument("--rows", type=int, default=1000)
    parser.add_argument("--columns", type=int, default=6, help="of numbers")
    parser.add_argument("--attitudes", type=int, default=0, help="groups q and q_inertial")
    parser.add_argument("--bins", type=int, default=256)
    parser.add_argument("--scatter", type=float, default=0.05, help="of the time of a chunk")
    parser.add_argument("--chunk", type=int, nargs="+", default=[100])
    parser.add_argument("--ranks", type=int, nargs="+", default=[100, 1000, 10000])
    parser.add_argument("--threads", type=int, default=1, help="of each rank")
    parser.add_argument("--start", type=float, default=0.0, help="seconds until all ranks work")
    parser.add_argument("--simulate", action="store_true", help="chunk by chunk as well: minutes")
    given = parser.parse_args()
    heads = ["ranks", "chunk", "MB a chunk", "s", "of which used, %", "bound by",
             "threads of use"]
    if given.simulate:
        heads[4:4] = ["simulated, s", "waiting, GB"]
    print("|", " | ".join(heads), "|")
    print("|" + "---|" * len(heads))
    for ranks in given.ranks:
        for chunk in given.chunk:
            ensemble = Ensemble(given.members, given.seconds, chunk, given.rows, given.columns,
                                given.attitudes, given.bins, scatter=given.scatter)
            if ranks > ensemble.chunks:  # refused
                continue
            cluster = Cluster(ranks, given.threads, given.start)
            print("|", " | ".join(map(str, line(ensemble, cluster, given.simulate))), "|")


if __name__ == "__main__":
    main()
