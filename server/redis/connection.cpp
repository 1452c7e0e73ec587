#include "server/redis/connection.h"

#include <array>

namespace gnomon::redis {
namespace {

Problem unusable(std::string reason) {
  return {ProblemCode::unavailable, "", std::move(reason), "", ""};
}

/// What comes before the first command. The last one shows that the server takes commands from this user.
std::vector<Command> greeting(const Address& address) {
  std::vector<Command> commands;
  if (!address.user.empty()) {
    commands.push_back({"AUTH", address.user, address.password});
  } else if (!address.password.empty()) {
    commands.push_back({"AUTH", address.password});
  }
  if (address.database != 0) commands.push_back({"SELECT", std::to_string(address.database)});
  commands.push_back({"PING"});
  return commands;
}

} // namespace

Result<std::unique_ptr<Connection>> Connection::open(const Address& address, const Call& call) {
  OpenedStream opened = Stream::open(address, call.deadline, call.cut);
  if (!opened.stream) return unusable(std::move(opened.reason));
  std::unique_ptr<Connection> connection(new Connection(std::move(opened.stream)));
  const auto replies = connection->exchange(greeting(address), call);
  if (!replies) return replies.problems();
  for (const Reply& reply : *replies) {
    if (reply.isError()) return unusable("It answers: " + reply.text);
  }
  return connection;
}

Problem Connection::failure(Step step) const {
  if (reader_.isBroken()) return unusable("Its reply is none of the protocol, or larger than was asked for");
  return unusable(step == Step::timedOut ? "It does not answer in time" : "The connection ended");
}

/// Moves bytes one way or both, and waits where none can be moved.
Connection::Step Connection::step(std::string_view& unsent, const Call& call) {
  std::array<char, 64 * 1024> room;
  const Moved sent = unsent.empty() ? Moved{} : stream_->send(unsent);
  unsent.remove_prefix(sent.bytes);
  const Moved received = stream_->receive(room);
  if (received.bytes > 0 && !reader_.feed({room.data(), received.bytes})) return Step::ended;
  if (sent.bytes > 0 || received.bytes > 0) return Clock::now() < call.deadline ? Step::moved : Step::timedOut;
  if (sent.isOver || received.isOver) return Step::ended;
  const auto events = static_cast<short>(sent.waitsFor | received.waitsFor);
  return waitFor(stream_->fd(), events, call.deadline, call.cut) ? Step::moved : Step::timedOut;
}

Result<std::vector<Reply>> Connection::exchange(std::span<const Command> commands, const Call& call) {
  std::string text;
  for (const Command& command : commands) text += wireText(command);
  std::string_view unsent = text;
  std::vector<Reply> replies;
  reader_.allow(call.limits);
  while (replies.size() < commands.size()) {
    if (auto reply = reader_.next()) {
      replies.push_back(*std::move(reply));
      continue;
    }
    const Step moved = reader_.isBroken() ? Step::ended : step(unsent, call);
    if (moved != Step::moved) return failure(moved);
  }
  if (!unsent.empty() || !reader_.isEmpty()) return unusable("It answers what it was not asked");
  return replies;
}

Result<std::optional<Reply>> Connection::receive(const Call& call) {
  std::string_view nothing;
  reader_.allow(call.limits);
  while (true) {
    if (auto reply = reader_.next()) return reply;
    const Step moved = reader_.isBroken() ? Step::ended : step(nothing, call);
    if (moved == Step::timedOut) return std::optional<Reply>();
    if (moved == Step::ended) return failure(moved);
  }
}

Status Connection::send(const Command& command, const Call& call) {
  const std::string text = wireText(command);
  std::string_view unsent = text;
  reader_.allow(call.limits);
  while (!unsent.empty()) {
    if (const Step moved = step(unsent, call); moved != Step::moved) return failure(moved);
  }
  return Done{};
}

bool Connection::isQuiet() {
  std::array<char, 1> room;
  const Moved received = stream_->receive(room);
  return received.bytes == 0 && !received.isOver;
}

} // namespace gnomon::redis
