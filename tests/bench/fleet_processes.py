"""What happens in the fleet of fleet_model.py: frames, the clients that ask for them, replicas that come and fail, and the
autoscaler, each a process of SimPy 2.3."""

from collections import OrderedDict, deque

import numpy
from SimPy.Simulation import Process, Resource, hold, release, request

PLACES = 2  # frames that a worker has in hand at once: one is drawn while another's scene is loaded
QUEUE_SECONDS = 10  # in which a request must get a place (`timeout queue`)
WEIGHT = 100


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
        counted.due += begun >= model.fleet.ignore
        if services.proxy:
            yield request, self, model.proxy
            yield hold, self, services.proxy / 1000
            yield release, self, model.proxy
        while True:
            replica = model.replica_for(scene)
            if replica is None:
                counted.refused += begun >= model.fleet.ignore
                return
            replica.in_flight += 1
            model.in_flight += 1
            arrived = sim.now()
            yield request, self, replica.places
            placed = sim.now()
            model.waits.append((placed, placed - arrived))  # gnomon_queue_wait_seconds
            if placed - arrived > QUEUE_SECONDS:
                yield release, self, replica.places
                self.leave(model, replica)
                counted.refused += begun >= model.fleet.ignore
                return
            more = 0.0
            counted.looked += begun >= model.fleet.ignore
            if scene in replica.cache:
                counted.hits += begun >= model.fleet.ignore
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
            yield request, self, replica.renderer
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
        scaler, sim, wanted = model.fleet.autoscaler, self.sim, deque([(0.0, model.wished)])
        past = deque([model.wished], maxlen=round(60 / scaler.period))  # the counts of a minute
        while True:
            yield hold, self, scaler.period
            now, count = sim.now(), model.wished
            while model.waits and model.waits[0][0] < now - scaler.lag - scaler.window:
                model.waits.popleft()
            seen = [wait for second, wait in model.waits if second <= now - scaler.lag]
            if not seen:
                continue
            ratio = 1000 * sum(seen) / len(seen) / scaler.target_ms
            desired = count if abs(ratio - 1) <= scaler.tolerance else -int(-count * ratio // 1)
            desired = min(max(desired, scaler.least), scaler.most, max(int((1 + scaler.rise) * count), count + scaler.more))
            wanted.append((now, desired))
            while wanted[0][0] < now - scaler.calm:
                wanted.popleft()
            desired = max(desired, min(count, max(each for _, each in wanted)))
            if desired < count:
                desired = max(desired, min(count, int((1 - scaler.fall) * past[0])))
            if desired > count:
                model.start(desired - count)
            for _ in range(count - desired):
                if len(model.replicas) > 1:
                    model.remove(max(model.replicas))
            model.wished = desired
            past.append(desired)
