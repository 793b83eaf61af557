// The content registry as bytes, for RegistryData. Asset folders of the server's machine are not part of it.
#pragma once

#include "base/bytes.h"
#include "base/result.h"
#include "world/block_registry.h"

#include <memory>

namespace vitrail::net {

Bytes encode_registry(const BlockRegistry& registry);
// Errors: damaged, limit (more than 65,536 blocks or 32,768 textures).
Result<std::shared_ptr<BlockRegistry>> decode_registry(ByteView bytes);
// XXH3 of encode_registry: equal hashes mean equal content.
u64 registry_hash(const BlockRegistry& registry);

} // namespace vitrail::net
