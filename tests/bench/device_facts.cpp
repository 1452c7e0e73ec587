#include "tests/bench/device_facts.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <sched.h>
#include <stdexcept>
#include <thread>

#include "tests/bench/bodies_scene.h"
#include "tests/bench/cost_series.h"
#include "tests/bench/gnomon_process.h"
#include "tests/bench/tools.h"

namespace gnomon::bench {
namespace {

using nlohmann::json;

constexpr int kClients = 30;
constexpr double kCrowdSeconds = 4;

int coreCount() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

/// A program with a scene of its own, asked frame after frame.
struct Lane {
  explicit Lane(const Program& program, const Bytes& glb)
      : server(program), connection(server.origin()), scene(connection.upload(glb)) {}
  double draw(const json& spec) { return connection.draw(scene, spec); }
  Server server;
  Connection connection;
  std::string scene;
};

json sized(json spec, int width, int height) {
  spec["width"] = width;
  spec["height"] = height;
  return spec;
}

const json& at(const BenchScene& scene, int round) {
  return scene.path[static_cast<std::size_t>(round) % scene.path.size()];
}

/// Of each device: the second of two times over the first, in turns.
template <class Pair>
DeviceFact ratio(const DeviceRun& run, const std::string& what, Pair&& pairOf) {
  DeviceFact fact{what, {}};
  for (const std::string& device : run.devices) {
    const std::vector<double> times = mediansInTurns(run.rounds, pairOf(device));
    fact.devices.push_back(times[1] / times[0]);
  }
  return fact;
}

DeviceFact ready(const DeviceRun& run) {
  std::vector<std::function<double(int)>> calls;
  for (const std::string& device : run.devices) {
    calls.emplace_back([&, device](int) { return Server({run.program, device}).readyMilliseconds(); });
  }
  DeviceFact fact{"server ready after its start, ms", {}, 0};
  for (const double time : mediansInTurns(run.rounds, calls)) fact.devices.emplace_back(time);
  return fact;
}

DeviceFact smallFrame(const DeviceRun& run, const BenchScene& demo) {
  const Bytes glb = testing::readFile(demo.file);
  std::vector<std::unique_ptr<Lane>> lanes;
  std::vector<std::function<double(int)>> calls;
  for (const std::string& device : run.devices) {
    lanes.push_back(std::make_unique<Lane>(Program{run.program, device}, glb));
    calls.emplace_back(
        [&, lane = lanes.back().get()](int round) { return lane->draw(sized(at(demo, round), 320, 180)); });
  }
  DeviceFact fact{"a frame of the demo, 320 x 180, defaults, ms", {}, 1};
  for (const double time : mediansInTurns(2 * run.rounds, calls)) fact.devices.emplace_back(time);
  return fact;
}

DeviceFact triangles(const DeviceRun& run) {
  const Bytes few = bodiesGlb(13), many = bodiesGlb(41);
  return ratio(run, "4.4 million triangles over 0.44 million, exact", [&](const std::string& device) {
    const auto lane = [&](const Bytes& glb) {
      return [served = std::make_shared<Lane>(Program{run.program, device}, glb)](int round) {
        json spec = {{"camera", {{"node", "camera"}}},
                     {"lights", {{{"sun", {{"azimuthDegrees", 150 + 0.05 * round}, {"elevationDegrees", 35}}}}}}};
        spec.update(settings().front().patch);
        return served->draw(sized(spec, 1280, 720));
      };
    };
    return std::vector<std::function<double(int)>>{lane(few), lane(many)};
  });
}

DeviceFact spots(const DeviceRun& run, const BenchScene& city) {
  const Bytes glb = testing::readFile(city.file);
  return ratio(run, "64 shadowed spots over one, city, defaults", [&](const std::string& device) {
    const auto served = std::make_shared<Lane>(Program{run.program, device}, glb);
    const auto lit = [&](int count) {
      return [served, count](int round) {
        json lights = cityLamps(count);
        for (json& light : lights) light["direction"][0] = light["direction"][0].get<double>() + 1e-4 * round;
        return served->draw(sized({{"camera", {{"node", "camera"}}}, {"lights", lights}}, 1280, 720));
      };
    };
    return std::vector<std::function<double(int)>>{lit(1), lit(64)};
  });
}

std::function<double(int)> exactly(const Program& program, const BenchScene& scene, const Bytes& glb) {
  return [served = std::make_shared<Lane>(program, glb), &scene](int round) {
    json spec = at(scene, round);
    spec.update(settings().front().patch);
    return served->draw(sized(spec, 1280, 720));
  };
}

DeviceFact cores(const DeviceRun& run, const BenchScene& scene) {
  const Bytes glb = testing::readFile(scene.file);
  return ratio(run, "one core over two, " + scene.name + ", exact", [&](const std::string& device) {
    return std::vector{exactly({run.program, device, "", 2}, scene, glb),
                       exactly({run.program, device, "", 1}, scene, glb)};
  });
}

/// Nothing where the processor lacks one of the two.
DeviceFact instructions(const DeviceRun& run, const BenchScene& scene) {
  DeviceFact fact{"AVX2 over AVX-512, " + scene.name + ", exact", {}};
  const Bytes glb = testing::readFile(scene.file);
  for (const std::string& device : run.devices) {
    if (device != "cpu") {
      fact.devices.emplace_back();
      continue;
    }
    const std::vector<double> times = mediansInTurns(run.rounds, {exactly({run.program, device, "avx3"}, scene, glb),
                                                                  exactly({run.program, device, "avx2"}, scene, glb)});
    fact.devices.emplace_back(times[1] / times[0]);
  }
  return fact;
}

/// The demo under a sun that no other number has: frames that are the same are drawn once for all who ask.
json onlyFrame(const BenchScene& demo, int number) {
  json spec = sized(demo.path.front(), 320, 180);
  json& azimuth = spec["lights"][0]["sun"]["azimuthDegrees"];
  azimuth = azimuth.get<double>() + 0.001 * number;
  return spec;
}

/// Frames a second that so many clients get together, each asking again as soon as it has its picture, of as many
/// workers as a server starts by itself.
double framesPerSecond(const Program& program, int clients, const BenchScene& demo, const Bytes& glb) {
  const Server server(program);
  const std::string scene = Connection(server.origin()).upload(glb);
  std::atomic<int> frames = 0;
  const auto begin = std::chrono::steady_clock::now() + std::chrono::milliseconds(500); // the first ones don't count
  const auto end = begin + std::chrono::duration<double>(kCrowdSeconds);
  std::vector<std::thread> threads;
  for (int client = 0; client < clients; ++client) {
    threads.emplace_back([&, client] {
      Connection connection(server.origin());
      for (int number = client;; number += clients) {
        connection.draw(scene, onlyFrame(demo, number));
        const auto now = std::chrono::steady_clock::now();
        if (now > end) return;
        if (now > begin) ++frames;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  return frames / kCrowdSeconds;
}

DeviceFact crowd(const DeviceRun& run, const BenchScene& demo) {
  const Bytes glb = testing::readFile(demo.file);
  DeviceFact fact{"30 clients at once over one client on one core, times the cores (frames a second, demo, 320 x 180)",
                  {}};
  for (const std::string& device : run.devices) {
    const std::vector<double> rates = mediansInTurns(
        std::min(run.rounds, 3), {[&](int) {
                                    return framesPerSecond({run.program, device, "", 1, 0}, 1, demo, glb);
                                  },
                                  [&](int) {
                                    return framesPerSecond({run.program, device, "", 0, 0}, kClients, demo, glb);
                                  }});
    fact.devices.emplace_back(rates[1] / (coreCount() * rates[0]));
  }
  return fact;
}

} // namespace

std::vector<DeviceFact> factsOf(const DeviceRun& run, const FactScenes& scenes) {
  std::vector<DeviceFact> facts = {ready(run), smallFrame(run, scenes.demo), triangles(run), spots(run, scenes.city)};
  if (coreCount() > 1) facts.push_back(cores(run, scenes.busy));
  try {
    facts.push_back(instructions(run, scenes.busy));
  } catch (const std::runtime_error&) {
    // this processor has not both
  }
  facts.push_back(crowd(run, scenes.demo));
  return facts;
}

} // namespace gnomon::bench
