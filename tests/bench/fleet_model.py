"""A fleet as a discrete-event simulation: clients, HAProxy with consistent hashing and bounded load, replicas with scenes in
memory, the store behind them, an autoscaler, and failures. SimPy 2.3 (Debian's python3-simpy)."""

import random
from collections import deque
from dataclasses import dataclass, field

import numpy
from SimPy.Simulation import Resource, Simulation

from fleet_processes import WEIGHT, Clients, Failure, Replica, Scaling, Start
from haproxy_ring import Ring, key_of, most_requests


@dataclass
class Services:
    """Milliseconds that parts take: lists of equally likely values, or of one."""

    frame: list  # drawing and encoding, one at a time in a replica
    load: list  # a scene from the store, beside frames
    first: list  # more than `frame` that the first frame after a load takes
    http: list  # front and proxy, beside all else
    proxy: float = 0.0  # of one of the proxy's threads
    store: float = 0.0  # of the store, which does one thing at a time, for a load


@dataclass
class Autoscaler:
    """HorizontalPodAutoscaler on the mean time that frames wait, with Kubernetes' defaults."""

    target_ms: float
    least: int
    most: int
    period: float = 15.0
    lag: float = 30.0  # seconds until what happened is in the metric
    window: float = 60.0  # over which it is averaged
    calm: float = 300.0  # scaling down goes to the largest count wanted in such a time
    tolerance: float = 0.1
    rise: float = 1.0  # share of the replicas that may be added in a period, or `more` of them
    more: int = 4
    fall: float = 1.0  # that may be taken away in a minute


@dataclass
class Fleet:
    replicas: int
    scenes: int
    rate: object  # requests a second, or a function of the time
    seconds: float
    services: Services
    held: int  # scenes that a replica's memory holds
    exponent: float = 1.0
    factor: int = 200  # hash-balance-factor; 0 = each request goes to the next replica in turn
    threads: int = 4  # of the proxy
    ignore: float = 0.0  # seconds at the beginning whose requests are not counted
    warm: bool = True  # memories hold at the start what is most popular
    start_seconds: float = 10.0  # from the wish for a replica to its first frame
    slow_start: float = 20.0
    mean_life: float = 0.0  # seconds until a replica fails; 0 = never
    autoscaler: Autoscaler = None
    trace: list = None  # (second, scene) of every request, instead of rate, seconds and exponent
    keys: list = None  # of scenes on the ring, instead of those made up
    seed: int = 1


@dataclass
class Outcome:
    """Of all requests that were counted."""

    begun: list = field(default_factory=list)
    seconds: list = field(default_factory=list)
    hits: int = 0  # of `looked`, frames that came to a place at a replica: their scene was in memory
    looked: int = 0
    refused: int = 0
    retried: int = 0
    replica_seconds: float = 0.0
    counts: list = field(default_factory=list)  # (second, replicas that serve)
    asked: int = 0  # from the beginning on
    due: int = 0  # of them, those that are counted, done or not
    loads: int = 0

    def hit_rate(self):
        return self.hits / self.looked


class Model:
    def __init__(self, fleet):
        self.fleet, self.outcome, self.random = fleet, Outcome(), random.Random(fleet.seed)
        self.sim = Simulation()
        self.sim.initialize()
        self.proxy = Resource(capacity=fleet.threads, sim=self.sim)
        self.store = Resource(capacity=1, sim=self.sim)
        self.replicas, self.weights, self.waits = {}, {}, deque(maxlen=None if fleet.autoscaler else 1)
        self.in_flight, self.turn, self.next_number, self.wished = 0, 0, fleet.replicas + 1, fleet.replicas
        made_up = numpy.random.default_rng(0).integers(0, 2**32, fleet.scenes)
        self.keys = numpy.array([key_of(each) for each in fleet.keys]) if fleet.keys else made_up
        self.changed = 0.0
        for number in range(1, fleet.replicas + 1):
            self.replicas[number] = Replica(self.sim, number, fleet.held)
            self.weights[number] = WEIGHT
        self.rearrange()
        if fleet.warm:
            self.fill()

    def fill(self):
        """Memories hold the most popular of their scenes: their own, those passed on by full ones, and what takes several of
        them; going round, of all scenes."""
        fleet, numbers = self.fleet, self.ring.numbers
        shares = 1 / numpy.arange(1, fleet.scenes + 1) ** fleet.exponent
        copies = (2 + shares / shares.sum() * len(numbers)).astype(int).tolist()
        chosen, room = {number: [] for number in numbers}, len(numbers)
        for scene, count in enumerate(copies):
            for number in self.ring.walk(self.points[scene], count) if fleet.factor else numbers:
                if len(chosen[number]) < fleet.held:
                    chosen[number].append(scene)
                    room -= len(chosen[number]) == fleet.held
            if not room:
                break
        for number, scenes in chosen.items():
            for scene in reversed(scenes):
                self.replicas[number].keep(scene)

    def rearrange(self):
        now = self.sim.now()
        self.outcome.replica_seconds += (now - self.changed) * (self.outcome.counts[-1][1] if self.outcome.counts else 0)
        self.changed = now
        self.outcome.counts.append((now, len(self.replicas)))
        if self.weights:
            self.ring = Ring(self.weights)
            self.points = self.ring.nearest(self.keys).tolist()
            self.index = {number: each for each, number in enumerate(self.ring.numbers)}

    def weigh(self, number, weight):
        self.weights[number] = weight
        self.rearrange()

    def remove(self, number):
        del self.replicas[number], self.weights[number]
        self.rearrange()

    def start(self, count):
        for _ in range(count):
            starting = Start(sim=self.sim)
            self.sim.activate(starting, starting.run(self, self.next_number))
            self.next_number += 1

    def fail_later(self, number):
        if self.fleet.mean_life:
            failure = Failure(sim=self.sim)
            self.sim.activate(failure, failure.run(self, number))

    def replica_for(self, scene):
        if not self.weights:
            return None
        numbers = self.ring.numbers
        if not self.fleet.factor:
            self.turn += 1
            return self.replicas[numbers[self.turn % len(numbers)]]

        def has_room(number):
            most = most_requests(self.index[number], len(numbers), self.in_flight, self.fleet.factor)
            return self.replicas[number].in_flight < most

        return self.replicas[self.ring.place(self.points[scene], has_room)]

    def run(self):
        fleet, sim = self.fleet, self.sim
        clients = Clients(sim=sim)
        sim.activate(clients, clients.run(self))
        if fleet.autoscaler:
            scaling = Scaling(sim=sim)
            sim.activate(scaling, scaling.run(self))
        for number in list(self.replicas):
            self.fail_later(number)
        end = fleet.trace[-1][0] + 60 if fleet.trace else fleet.seconds
        sim.simulate(until=end)
        self.outcome.replica_seconds += (end - self.changed) * len(self.replicas)
        return self.outcome
