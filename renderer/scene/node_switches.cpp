#include "renderer/scene/node_switches.h"

#include <algorithm>

namespace gnomon {

bool ReceiverGroups::matter() const {
  return std::any_of(ofLight.begin(), ofLight.end(), [](const LitGroups& groups) { return groups != LitGroups{}; });
}

} // namespace gnomon
