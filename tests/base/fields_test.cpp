#include "base/fields.h"

#include "base/rng.h"

#include <gtest/gtest.h>

using namespace vitrail;

namespace {

enum class Color : u8 { red, green };

struct Inner {
    i32 value = 7;
    std::string text;
    static constexpr auto fields = std::tuple{field<1>("value", &Inner::value, {.least_value = -10, .most_value = 10}),
                                              field<2>("text", &Inner::text, {.most = 8})};
};

struct Outer {
    u64 big = 0;
    bool flag = false;
    float ratio = 0;
    Color color = Color::red;
    std::vector<i32> numbers;
    std::vector<Inner> inners;
    Inner one;
    Bytes raw;
    static constexpr auto fields = std::tuple{field<1>("big", &Outer::big),
                                              field<2>("flag", &Outer::flag),
                                              field<3>("ratio", &Outer::ratio),
                                              field<4>("color", &Outer::color),
                                              field<5>("numbers", &Outer::numbers, {.most = 4}),
                                              field<6>("inners", &Outer::inners, {.most = 3}),
                                              field<7>("one", &Outer::one),
                                              field<9>("raw", &Outer::raw, {.most = 16})};
};

// A later version of Inner that has grown.
struct GrownInner {
    i32 value = 0;
    std::string text;
    std::vector<std::string> more;
    float extra = 0;
    u32 last = 0;
    static constexpr auto fields = std::tuple{
        field<1>("value", &GrownInner::value), field<2>("text", &GrownInner::text), field<3>("more", &GrownInner::more),
        field<4>("extra", &GrownInner::extra), field<5>("last", &GrownInner::last)};
};

Outer sample() {
    Outer o;
    o.big = ~u64(0);
    o.flag = true;
    o.ratio = -1.5f;
    o.color = Color::green;
    o.numbers = {-1, 0, 2147483647};
    o.inners = {{1, "a"}, {-10, "12345678"}};
    o.one = {10, ""};
    o.raw = {1, 2, 3};
    return o;
}

} // namespace

TEST(Fields, RoundTrip) {
    const auto back = decode_fields<Outer>(encode_fields(sample()));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->big, ~u64(0));
    EXPECT_TRUE(back->flag);
    EXPECT_EQ(back->ratio, -1.5f);
    EXPECT_EQ(back->color, Color::green);
    EXPECT_EQ(back->numbers, (std::vector<i32>{-1, 0, 2147483647}));
    ASSERT_EQ(back->inners.size(), 2u);
    EXPECT_EQ(back->inners[1].value, -10);
    EXPECT_EQ(back->inners[1].text, "12345678");
    EXPECT_EQ(back->raw, (Bytes{1, 2, 3}));
}

TEST(Fields, UnknownFieldsAreSkippedAndMissingOnesKeepDefaults) {
    GrownInner grown{3, "x", {"p", "q"}, 2.0f, 9};
    const auto old = decode_fields<Inner>(encode_fields(grown));
    ASSERT_TRUE(old);
    EXPECT_EQ(old->value, 3);
    EXPECT_EQ(old->text, "x");
    const auto empty = decode_fields<Inner>({});
    ASSERT_TRUE(empty);
    EXPECT_EQ(empty->value, 7);
}

TEST(Fields, LimitsHold) {
    EXPECT_FALSE(decode_fields<Inner>(encode_fields(Inner{11, ""})));
    EXPECT_FALSE(decode_fields<Inner>(encode_fields(Inner{1, "123456789"})));
    Outer o;
    o.numbers.assign(5, 1);
    EXPECT_FALSE(decode_fields<Outer>(encode_fields(o)));
    o = {};
    o.inners.assign(4, {});
    EXPECT_FALSE(decode_fields<Outer>(encode_fields(o)));
    o = {};
    o.ratio = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(decode_fields<Outer>(encode_fields(o)));
}

TEST(Fields, EveryTruncationFailsOrParsesAPrefix) {
    const Bytes whole = encode_fields(sample());
    for (std::size_t n = 0; n < whole.size(); ++n)
        (void)decode_fields<Outer>(ByteView(whole).first(n));
}

TEST(Fields, RandomBytesNeverReadBeyondTheirEnd) {
    Rng rng(5);
    const Bytes whole = encode_fields(sample());
    for (int i = 0; i < 20000; ++i) {
        Bytes bytes = whole;
        for (u32 k = rng.below(4) + 1; k > 0; --k)
            bytes[rng.below(u32(bytes.size()))] = u8(rng.next());
        (void)decode_fields<Outer>(bytes);
    }
}

TEST(Bytes, VarintEdges) {
    for (u64 v : {u64(0), u64(127), u64(128), u64(1) << 32, ~u64(0)}) {
        ByteWriter out;
        out.put_varint(v);
        ByteReader in(out.bytes());
        EXPECT_EQ(in.get_varint(), v);
        EXPECT_TRUE(in.finished());
    }
    for (i64 v : {i64(0), i64(-1), std::numeric_limits<i64>::min(), std::numeric_limits<i64>::max()}) {
        ByteWriter out;
        out.put_svarint(v);
        ByteReader in(out.bytes());
        EXPECT_EQ(in.get_svarint(), v);
    }
    const Bytes endless(11, 0xff);
    ByteReader in(endless);
    EXPECT_EQ(in.get_varint(), 0u);
    EXPECT_TRUE(in.failed());
}
