#include "trace/film/stages_impl.h"

namespace vitrail::trace {

FilmStages film_stages_avx2();
FilmStages film_stages_avx2() {
    return make_film_stages<int(FilmVectors::avx2)>();
}

} // namespace vitrail::trace
