#include "renderer/passes/program_cache.h"

namespace gnomon {

Result<const gl::Program*> ProgramCache::get(const gl::ProgramSource& source) {
  std::string key = source.vertex + "+" + source.fragment;
  for (const std::string& define : source.defines) key += " " + define;
  const auto found = programs_.find(key);
  if (found != programs_.end()) return &found->second;
  auto program = gl::Program::create(source, key);
  if (!program) return program.problems();
  return &programs_.emplace(std::move(key), std::move(*program)).first->second;
}

} // namespace gnomon
