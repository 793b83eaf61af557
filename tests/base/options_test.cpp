#include "base/options.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace vitrail {
namespace {

struct Taste {
    bool sweet = true;
    i32 size = 3, kind = 1;
    float heat = 0.5f;
    bool operator==(const Taste&) const = default;
};

constexpr const char* kKinds[] = {"bread", "cake", "soup"};

const OptionOf<Taste> kTable[] = {
    {"sweet", "Sweet", "Or not.", [](Taste& t) -> OptionMember { return &t.sweet; }},
    {"size", "Size", "How much.", [](Taste& t) -> OptionMember { return &t.size; }, -2, 9},
    {"kind", "Kind", "What.", [](Taste& t) -> OptionMember { return &t.kind; }, 0, 2, kKinds},
    {"heat", "Heat", "How hot.", [](Taste& t) -> OptionMember { return &t.heat; }, 0.25f, 80},
};

std::string message(const char* key, const char* value) {
    Taste taste;
    const Result<> set = set_option(*find_option<OptionOf<Taste>>(kTable, key), taste, value);
    EXPECT_EQ(taste == Taste(), !set) << key << " = " << value;
    if (!set) EXPECT_EQ(set.error().code, ErrorCode::invalid_argument);
    return set ? "" : set.error().message;
}

TEST(Options, SayWhatIsAllowed) {
    EXPECT_EQ(message("sweet", "perhaps"), "sweet is true or false, not 'perhaps'");
    EXPECT_EQ(message("size", "10"), "size is a whole number from -2 to 9, not '10'");
    EXPECT_EQ(message("kind", "stew"), "kind is one of bread, cake, soup, not 'stew'");
    EXPECT_EQ(message("heat", "0.2"), "heat is a number from 0.25 to 80, not '0.2'");
    EXPECT_EQ(option_row(kTable[3]), "| `heat` | Heat: How hot. | a number from 0.25 to 80 |");
    EXPECT_EQ(find_option<OptionOf<Taste>>(kTable, "siz"), nullptr);
}

TEST(Options, TakeTheEndsOfTheirRangeAndNothingBeyond) {
    for (const auto& [key, value] : {std::pair{"size", "-2"},
                                     {"size", "9"},
                                     {"heat", "0.25"},
                                     {"heat", "8e1"},
                                     {"sweet", "off"},
                                     {"sweet", "0"},
                                     {"sweet", "false"},
                                     {"kind", "soup"}})
        EXPECT_EQ(message(key, value), "") << key << value;
    for (const char* value : {"", " 3", "3 ", "+3", "3.0", "0x3", "-3", "10", "2147483648", "99999999999999999999"})
        EXPECT_NE(message("size", value), "") << value;
    for (const char* value : {"", "nan", "inf", "-inf", "1e999", "1,5", "0.2499999", "80.00001", "hot"})
        EXPECT_NE(message("heat", value), "") << value;
    for (const char* value : {"", "1", "Cake", "cake ", "bread, cake"})
        EXPECT_NE(message("kind", value), "") << value;
    for (const char* value : {"", "yes", "TRUE", "2"})
        EXPECT_NE(message("sweet", value), "") << value;
}

TEST(Options, AreReadAsTheyAreShown) {
    Taste odd{false, -2, 2, 0.3000001f};
    Taste back;
    for (const auto& row : kTable)
        ASSERT_TRUE(set_option(row, back, option_text(row, odd))) << row.key;
    EXPECT_TRUE(back == odd);
    EXPECT_EQ(option_text(kTable[0], odd), "false");
    EXPECT_EQ(option_text(kTable[2], odd), "soup");
    odd.kind = 77; // names are never read beyond their end
    EXPECT_EQ(option_text(kTable[2], odd), "soup");
}

TEST(Options, AreHeldInRange) {
    const std::span<const OptionOf<Taste>> table = kTable;
    Taste far{true, std::numeric_limits<i32>::max(), -5, std::numeric_limits<float>::infinity()};
    hold_options(table, far, Taste());
    EXPECT_TRUE(far == (Taste{true, 9, 0, 80}));
    far.heat = NAN, far.size = std::numeric_limits<i32>::min();
    hold_options(table, far, Taste());
    EXPECT_TRUE(far == (Taste{true, -2, 0, 0.5f}));
}

} // namespace
} // namespace vitrail
