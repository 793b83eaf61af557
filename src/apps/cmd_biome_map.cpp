#include "apps/commands.h"
namespace vitrail::apps {
Result<> run_biome_map(const BiomeMapOptions&) { return fail(ErrorCode::unsupported, "not built yet"); }
} // namespace vitrail::apps
