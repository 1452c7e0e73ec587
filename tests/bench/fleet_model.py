"""A fleet as a discrete-event simulation: clients, HAProxy with consistent hashing and bounded load, replicas with scenes in
memory, the store behind them, an autoscaler, and failures. SimPy 2.3 (Debian's python3-simpy)."""

from collections import OrderedDict, deque
from dataclasses import dataclass, field

import numpy
from SimPy.Simulation import Process, Resource, Simulation, hold, release, request

from haproxy_ring import Ring, key_of, most_requests

PLACES = 2  # frames that a worker has in hand at once: one is drawn while another's scene is loaded
QUEUE_SECONDS = 10  # in which a request must get a place (`timeout queue`)
WEIGHT = 100


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
    hits: int = 0
    refused: int = 0
    retried: int = 0
    replica_seconds: float = 0.0
    counts: list = field(default_factory=list)  # (second, replicas that serve)
    asked: int = 0  # from the beginning on
    loads: int = 0


class Replica:
    def __init__(self, sim, number, held):
        self.number, self.held = number, held
        self.places = Resource(capacity=PLACES, sim=sim)
        self.renderer = Resource(capacity=1, sim=sim)
        self.cache = OrderedDict()
        self.loading = {}  # scene -> when it will be there
        self.in_flight = 0
        self.died = None

    def keep(self, scene):
        self.cache[scene] = True
        self.cache.move_to_end(scene)
        if len(self.cache) > self.held:
            self.cache.popitem(last=False)


class Frame(Process):
    def run(self, model, scene):
        sim, random, services, counted = self.sim, model.random, model.fleet.services, model.outcome
        begun = sim.now()
        counted.asked += 1
        if services.proxy:
            yield request, self, model.proxy
            yield hold, self, services.proxy / 1000
            yield release, self, model.proxy
        while True:
            replica = model.replica_for(scene)
            replica.in_flight += 1
            model.in_flight += 1
            arrived = sim.now()
            yield request, self, replica.places
            placed = sim.now()
            if placed - arrived > QUEUE_SECONDS:
                yield release, self, replica.places
                self.leave(model, replica)
                counted.refused += begun >= model.fleet.ignore
                return
            found, more = scene in replica.cache, 0.0
            if found:
                replica.cache.move_to_end(scene)
            elif scene in replica.loading:
                yield hold, self, max(0.0, replica.loading[scene] - sim.now())
            else:
                counted.loads += 1
                load = random.choice(services.load) / 1000
                replica.loading[scene] = sim.now() + load + services.store / 1000
                if services.store:
                    yield request, self, model.store
                    yield hold, self, services.store / 1000
                    yield release, self, model.store
                yield hold, self, load
                replica.loading.pop(scene, None)
                replica.keep(scene)
                more = random.choice(services.first) / 1000
            asked = sim.now()
            yield request, self, replica.renderer
            model.waits.append((sim.now(), placed - arrived + sim.now() - asked))
            yield hold, self, random.choice(services.frame) / 1000 + more
            yield release, self, replica.renderer
            yield release, self, replica.places
            self.leave(model, replica)
            if replica.died is None or replica.died < arrived:
                break
            counted.retried += 1  # it died meanwhile: the proxy asks another one
        yield hold, self, random.choice(services.http) / 1000
        if begun >= model.fleet.ignore:
            counted.begun.append(begun)
            counted.seconds.append(sim.now() - begun)
            counted.hits += found

    def leave(self, model, replica):
        replica.in_flight -= 1
        model.in_flight -= 1


class Clients(Process):
    def run(self, model):
        fleet, sim = model.fleet, self.sim
        if fleet.trace is not None:
            for second, scene in fleet.trace:
                yield hold, self, second - sim.now()
                self.ask(model, scene)
            return
        random = numpy.random.default_rng(fleet.seed)
        weights = numpy.cumsum(1 / numpy.arange(1, fleet.scenes + 1) ** fleet.exponent)
        while sim.now() < fleet.seconds:
            scenes = numpy.searchsorted(weights, random.random(4096) * weights[-1]).tolist()
            for scene, pause in zip(scenes, random.exponential(1.0, 4096).tolist()):
                yield hold, self, pause / (fleet.rate(sim.now()) if callable(fleet.rate) else fleet.rate)
                if sim.now() >= fleet.seconds:
                    return
                self.ask(model, scene)

    def ask(self, model, scene):
        frame = Frame(sim=self.sim)
        self.sim.activate(frame, frame.run(model, scene))


class Start(Process):
    """Of a replica, which then takes its share within the slow start."""

    def run(self, model, number):
        fleet = model.fleet
        yield hold, self, fleet.start_seconds
        model.replicas[number] = Replica(self.sim, number, fleet.held)
        model.fail_later(number)
        steps = 4 if fleet.slow_start else 1
        for step in range(1, steps + 1):
            model.weigh(number, WEIGHT * step // steps)
            yield hold, self, fleet.slow_start / steps
            if number not in model.replicas:
                return


class Failure(Process):
    """Of a replica, for which another one is started."""

    def run(self, model, number):
        yield hold, self, model.random.expovariate(1 / model.fleet.mean_life)
        if number in model.replicas:
            model.replicas[number].died = self.sim.now()
            model.remove(number)
            model.start(1)


class Scaling(Process):
    def run(self, model):
        scaler, sim, wanted = model.fleet.autoscaler, self.sim, deque()
        while True:
            yield hold, self, scaler.period
            now, count = sim.now(), model.wished
            while model.waits and model.waits[0][0] < now - scaler.lag - scaler.window:
                model.waits.popleft()
            seen = [wait for second, wait in model.waits if second <= now - scaler.lag]
            ratio = 1000 * sum(seen) / len(seen) / scaler.target_ms if seen else 0.0
            desired = count if abs(ratio - 1) <= scaler.tolerance else -int(-count * ratio // 1)
            desired = min(max(desired, scaler.least), scaler.most, max(2 * count, count + 4))
            wanted.append((now, desired))
            while wanted[0][0] < now - scaler.calm:
                wanted.popleft()
            desired = max(desired, min(count, max(each for _, each in wanted)))
            if desired > count:
                model.start(desired - count)
            for _ in range(count - desired):
                if len(model.replicas) > 1:
                    model.remove(max(model.replicas))
            model.wished = desired


class Model:
    def __init__(self, fleet):
        import random

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
        """Memories hold the most popular of their own scenes; going round, of all scenes."""
        homes = [self.ring.owners[point] for point in self.points]
        rest = {number: replica.held for number, replica in self.replicas.items()}
        chosen = {number: [] for number in rest}
        for scene in range(self.fleet.scenes):
            for number in [homes[scene]] if self.fleet.factor else list(rest):
                if rest.get(number):
                    chosen[number].append(scene)
                    rest[number] -= 1
                    if not rest[number]:
                        del rest[number]
            if not rest:
                break
        for number, scenes in chosen.items():
            for scene in reversed(scenes):
                self.replicas[number].keep(scene)

    def rearrange(self):
        now = self.sim.now()
        self.outcome.replica_seconds += (now - self.changed) * (self.outcome.counts[-1][1] if self.outcome.counts else 0)
        self.changed = now
        self.outcome.counts.append((now, len(self.replicas)))
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
