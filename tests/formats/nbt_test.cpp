#include "formats/nbt.h"

#include "base/rng.h"

#include <gtest/gtest.h>

namespace vitrail::nbt {
namespace {

Bytes sample() {
    Writer w;
    const i32 ints[] = {1, -2, 3};
    const u64 longs[] = {5, ~0ull};
    const u8 bytes[] = {7, 8};
    w.begin_compound("root").put_byte("b", -1).put_short("s", -300).put_int("i", 70000).put_long("l", -5000000000);
    w.put_float("f", 1.5f).put_double("d", -2.25).put_string("t", "h\xc3\xa9llo").put_bytes("ba", bytes);
    w.put_ints("ia", ints).put_longs("la", longs);
    w.begin_list("numbers", Type::float64, 2).put_double("", 1.5).put_double("", 2.5).end_list();
    w.begin_list("empty", Type::end, 0).end_list();
    w.begin_list("things", Type::compound, 2);
    w.begin_compound().put_int("x", 1).end_compound().begin_compound().put_int("x", 2).end_compound().end_list();
    w.begin_list("nested", Type::list, 1).begin_list("", Type::string, 2).put_string("", "a").put_string("", "b");
    w.end_list().end_list().begin_compound("c").put_int("y", 9).end_compound().end_compound();
    return w.take();
}

TEST(Nbt, ReadsWhatIsWritten) {
    const Bytes bytes = sample();
    Document doc;
    ASSERT_TRUE(doc.parse(bytes));
    EXPECT_EQ(doc.bytes_used(), bytes.size());
    const Tag r = doc.root();
    EXPECT_EQ(r.name(), "root");
    EXPECT_EQ(r.size(), 15u);
    EXPECT_EQ(r["b"].integer(), -1);
    EXPECT_EQ(r["s"].integer(), -300);
    EXPECT_EQ(r["i"].integer(), 70000);
    EXPECT_EQ(r["l"].integer(), -5000000000);
    EXPECT_EQ(r["f"].number(), 1.5);
    EXPECT_EQ(r["d"].number(), -2.25);
    EXPECT_EQ(r["d"].integer(), -2);
    EXPECT_EQ(r["t"].text(), "h\xc3\xa9llo");
    EXPECT_EQ(r["ba"].bytes().size(), 2u);
    EXPECT_EQ(r["ba"].integer_at(1), 8);
    EXPECT_EQ(r["ia"].integer_at(1), -2);
    EXPECT_EQ(r["la"].integer_at(1), -1);
    EXPECT_EQ(r["la"].longs().size(), 16u);
    EXPECT_EQ(r["numbers"].number_at(1), 2.5);
    EXPECT_EQ(r["numbers"].number_at(2), 0);
    EXPECT_EQ(r["empty"].size(), 0u);
    i64 sum = 0;
    for (const Tag thing : r["things"])
        sum += thing["x"].integer();
    EXPECT_EQ(sum, 3);
    EXPECT_EQ(r["nested"].first_child().first_child().next_sibling().text(), "b");
    EXPECT_EQ(r["c"]["y"].integer(), 9);
    EXPECT_FALSE(r["none"]);
    EXPECT_EQ(r["none"]["below"].integer(42), 42);
    EXPECT_EQ(r["t"].integer(42), 42);
}

TEST(Nbt, KeepsACompoundAsADocumentOfItsOwn) {
    const Bytes bytes = sample();
    Document doc, own;
    ASSERT_TRUE(doc.parse(bytes));
    const Bytes blob = document_of(doc.root()["things"].first_child());
    ASSERT_TRUE(own.parse(blob));
    EXPECT_EQ(own.root()["x"].integer(), 1);
    EXPECT_TRUE(document_of(doc.root()["i"]).empty());
    Writer w;
    w.begin_compound();
    for (const Tag tag : doc.root())
        w.put_tag(tag.name(), tag);
    w.end_compound();
    const Bytes copy = w.take();
    ASSERT_TRUE(own.parse(copy));
    EXPECT_EQ(own.root().payload().size(), doc.root().payload().size());
}

// Cut anywhere, all that came before is there and nothing reaches beyond the cut.
TEST(Nbt, SavesWhatCameBeforeTheCut) {
    const Bytes bytes = sample();
    std::size_t most = 0;
    for (std::size_t cut = 0; cut < bytes.size(); ++cut) {
        const Bytes part(bytes.begin(), bytes.begin() + std::ptrdiff_t(cut)); // a copy, so that asan sees the end
        Document doc;
        EXPECT_FALSE(doc.parse(part));
        ASSERT_TRUE(doc.error());
        const Tag r = doc.root();
        EXPECT_FALSE(r.complete());
        EXPECT_GE(r.size(), most);
        most = r.size();
        if (cut > 60) {
            EXPECT_EQ(r["i"].integer(), 70000);
        }
        for (const Tag tag : r) {
            EXPECT_LE(tag.payload().data() + tag.payload().size(), part.data() + part.size());
            for (const Tag child : tag)
                (void)document_of(child);
            (void)tag.number_at(tag.size() - 1);
        }
        std::size_t children = 0;
        for (Tag t = r["things"].first_child(); t; t = t.next_sibling())
            ++children;
        EXPECT_EQ(children, r["things"].size());
    }
    EXPECT_EQ(most, 15u);
}

TEST(Nbt, BoundsDepthAndCounts) {
    Document doc;
    Bytes deep = {10, 0, 0};
    for (int i = 0; i < 600; ++i)
        deep.insert(deep.end(), {10, 0, 0});
    EXPECT_FALSE(doc.parse(deep));
    EXPECT_EQ(doc.error()->code, ErrorCode::limit);
    // A list of two billion compounds, strings, bytes in a few bytes of input.
    for (const u8 type : {1, 8, 9, 10, 12}) {
        Bytes huge = {10, 0, 0, 9, 0, 1, 'x', type, 0x7f, 0xff, 0xff, 0xff, 0, 0};
        EXPECT_FALSE(doc.parse(huge));
        EXPECT_LE(doc.root()["x"].size(), 3u);
    }
    // Elements of type end take no bytes; they are none.
    Bytes ends = {10, 0, 0, 9, 0, 1, 'x', 0, 0x7f, 0xff, 0xff, 0xff, 0};
    EXPECT_TRUE(doc.parse(ends));
    EXPECT_EQ(doc.root()["x"].size(), 0u);
    Bytes many = {10, 0, 0, 9, 0, 1, 'x', 10, 0, 0x40, 0, 0};
    many.resize(many.size() + 0x400000);
    EXPECT_FALSE(doc.parse(many));
    EXPECT_EQ(doc.error()->code, ErrorCode::limit);
    for (const u8 type : {13, 99, 255}) {
        Bytes wrong = {10, 0, 0, type, 0, 0, 0};
        EXPECT_FALSE(doc.parse(wrong));
    }
    EXPECT_FALSE(doc.parse({}));
}

void walk(const Tag& tag, int depth, u64& sum) {
    sum += tag.name().size() + tag.text().size() + tag.payload().size();
    if (tag.size() > 0) sum += u64(tag.integer_at(tag.size() - 1)) + u64(tag.integer());
    for (const u8 b : tag.bytes())
        sum += b;
    if (depth < 600)
        for (const Tag child : tag)
            walk(child, depth + 1, sum);
}

TEST(Nbt, SurvivesRandomDamage) {
    const Bytes good = sample();
    Rng rng(7);
    u64 sum = 0;
    for (int run = 0; run < 20000; ++run) {
        Bytes bytes = good;
        for (u32 n = 1 + rng.below(4); n > 0; --n)
            bytes[rng.below(u32(bytes.size()))] = u8(rng.next());
        Document doc;
        doc.parse(bytes);
        walk(doc.root(), 0, sum);
    }
    EXPECT_NE(sum, 0u);
}

} // namespace
} // namespace vitrail::nbt
