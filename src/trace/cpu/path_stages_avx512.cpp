#include "trace/cpu/path_stages.h"

namespace vitrail::trace::stream {

PathStages path_stages_avx512() {
    return make_path_stages<int(StreamCode::avx512)>();
}

} // namespace vitrail::trace::stream
