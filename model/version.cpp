#include "model/version.hpp"

namespace arcwall {

std::string program_version() { return ARCWALL_VERSION; }

}  // namespace arcwall
