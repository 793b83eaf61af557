#include "trace/film/stages_impl.h"

namespace vitrail::trace {

FilmStages film_stages_avx512();
FilmStages film_stages_avx512() {
    return make_film_stages<int(FilmVectors::avx512)>();
}

} // namespace vitrail::trace
