#include "base/rng.h"
#include "trace/places.h"

#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

TEST(Places, AreNeverLentTwiceAndLentAgain) {
    Places places(3);
    std::vector<u32> owner(3, ~0u); // of every entry; 0: free
    struct Loan {
        u32 at, size;
    };
    std::vector<Loan> loans;
    Rng rng(5);
    u64 used = 0, most = 0;
    for (u32 n = 1; n < 20'000; ++n) {
        if (loans.empty() || rng.below(100) < 52) {
            const u32 size = 1u << rng.below(5), at = places.take(size);
            owner.resize(std::max<std::size_t>(owner.size(), places.end()), 0);
            ASSERT_LE(at + size, places.end());
            for (u32 i = at; i < at + size; ++i) {
                ASSERT_EQ(owner[i], 0u);
                owner[i] = n;
            }
            loans.push_back({at, size});
            used += size;
        } else {
            std::swap(loans[rng.below(u32(loans.size()))], loans.back());
            const Loan l = loans.back();
            loans.pop_back();
            std::fill_n(owner.begin() + l.at, l.size, 0);
            places.give(l.at, l.size);
            used -= l.size;
        }
        ASSERT_EQ(places.used(), used);
        most = std::max(most, used);
    }
    EXPECT_LT(places.end(), 2 * most); // five sizes, equally wanted
    places.clear();
    EXPECT_EQ(places.end(), 3u);
    EXPECT_EQ(places.used(), 0u);
    EXPECT_EQ(places.take(4), 3u);
}

} // namespace
} // namespace vitrail::trace
