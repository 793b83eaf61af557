#include "formats/resource_pack.h"

#include "formats/builders.h"
#include "formats/zip_builder.h"

#include <fstream>
#include <gtest/gtest.h>

namespace vitrail {

namespace fs = std::filesystem;
using test::ZipBuilder;

namespace {

constexpr std::string_view kMeta = R"({"pack":{"pack_format":15,"description":"a\nb"}})";

void put(const fs::path& file, std::string_view text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

ByteView view_of(const std::string_view text) {
    return {reinterpret_cast<const u8*>(text.data()), text.size()};
}

std::string text(const Result<Bytes>& bytes) {
    return bytes ? std::string(bytes->begin(), bytes->end()) : "error: " + bytes.error().message;
}

std::shared_ptr<const ResourcePack> zip_of(ZipBuilder& zip, PackReport& report) {
    auto pack = ResourcePack::from_zip(zip.bytes(), "test.zip", report);
    EXPECT_TRUE(pack) << pack.error().message;
    return pack ? *pack : nullptr;
}

} // namespace

TEST(ResourcePack, FolderAndZipGiveTheSameFiles) {
    test::TempFolder folder;
    ZipBuilder zip;
    zip.add("pack.mcmeta", kMeta);
    put(folder.path() / "pack.mcmeta", kMeta);
    for (const char* name :
         {"assets/minecraft/textures/block/stone.png", "assets/mod/models/block/a b.json", "assets/minecraft/x.txt"}) {
        zip.add(name, name, {.deflate = true});
        put(folder.path() / name, name);
    }
    zip.add("notes.txt", "not an asset");
    put(folder.path() / "notes.txt", "not an asset");
    std::ofstream(folder.path() / "p.zip", std::ios::binary) << text(zip.bytes());

    PackReport report;
    for (const fs::path& path : {folder.path(), folder.path() / "p.zip"}) {
        const auto opened = ResourcePack::open(path, report);
        ASSERT_TRUE(opened) << opened.error().message;
        const ResourcePack& pack = **opened;
        EXPECT_EQ(pack.info().format, 15);
        EXPECT_EQ(pack.info().description, "a b");
        EXPECT_EQ(pack.file_count(), 3u);
        EXPECT_EQ(text(pack.read("minecraft/textures/block/stone.png", 100)),
                  "assets/minecraft/textures/block/stone.png");
        EXPECT_EQ(pack.list("mod/", ".json"), std::vector<std::string>{"mod/models/block/a b.json"});
        EXPECT_FALSE(pack.contains("notes.txt"));
        EXPECT_EQ(pack.read("minecraft/none", 100).error().code, ErrorCode::not_found);
        EXPECT_EQ(pack.read("minecraft/x.txt", 5).error().code, ErrorCode::limit);
    }
    EXPECT_EQ(report.problems, 0u) << report.lines[0];
}

TEST(ResourcePack, APackInsideAFolderAndBareTexturesAreFound) {
    PackReport report;
    ZipBuilder nested;
    nested.add("My Pack/pack.mcmeta", kMeta);
    nested.add("My Pack/assets/minecraft/textures/block/a.png", "a");
    EXPECT_TRUE(zip_of(nested, report)->contains("minecraft/textures/block/a.png"));
    ZipBuilder bare;
    bare.add("pack.mcmeta", R"({"pack":{"pack_format":2,"description":{"text":"x","extra":["y"]}}})");
    bare.add("textures/blocks/a.png", "a");
    bare.add("scripts/a.js", "a");
    const auto pack = zip_of(bare, report);
    EXPECT_TRUE(pack->contains("minecraft/textures/blocks/a.png"));
    EXPECT_EQ(pack->file_count(), 1u);
    EXPECT_TRUE(pack->info().old_names());
    EXPECT_EQ(pack->info().description, "xy");
}

TEST(ResourcePack, NothingLeadsOutOfAPack) {
    ZipBuilder zip;
    zip.add("pack.mcmeta", kMeta);
    for (const char* name : {"assets/minecraft/../../../etc/passwd", "/assets/minecraft/a", "assets/minecraft//b",
                             "assets/./c/d", "assets\\minecraft\\e", "C:/assets/minecraft/f", "assets/minecraft/.."})
        zip.add(name, "bad");
    zip.add("assets/minecraft/good", "good");
    PackReport report;
    const auto pack = zip_of(zip, report);
    EXPECT_EQ(pack->file_count(), 1u);
    EXPECT_EQ(report.problems, 1u);
    EXPECT_NE(report.lines.at(0).find("7 files"), std::string::npos) << report.lines[0];
    for (const char* name : {"../x", "a/../x", "/x", "a:b:c", "", "x\\y", "a//b", "a/b:c"})
        EXPECT_FALSE(parse_resource_name(name)) << name;
    EXPECT_EQ(parse_resource_name("block/stone")->file("textures", ".png"), "minecraft/textures/block/stone.png");
    EXPECT_EQ(parse_resource_name("mod:a")->text(), "mod:a");
}

TEST(ResourcePack, LinksOfAFolderAreNotFollowed) {
    test::TempFolder folder;
    put(folder.path() / "secret/s.png", "secret");
    const fs::path pack_folder = folder.path() / "pack";
    put(pack_folder / "pack.mcmeta", kMeta);
    put(pack_folder / "assets/minecraft/textures/block/own.png", "own");
    fs::create_symlink(folder.path() / "secret/s.png", pack_folder / "assets/minecraft/textures/block/link.png");
    fs::create_directory_symlink(folder.path() / "secret", pack_folder / "assets/minecraft/textures/folder");
    PackReport report;
    const auto pack = ResourcePack::open(pack_folder, report);
    ASSERT_TRUE(pack);
    EXPECT_EQ((*pack)->file_count(), 1u);
    EXPECT_NE(report.lines.at(0).find("2 links"), std::string::npos) << report.lines[0];
    // Nor where a file becomes a link after it was listed.
    fs::remove(pack_folder / "assets/minecraft/textures/block/own.png");
    fs::create_symlink(folder.path() / "secret/s.png", pack_folder / "assets/minecraft/textures/block/own.png");
    EXPECT_FALSE((*pack)->read("minecraft/textures/block/own.png", 100));
}

TEST(ResourcePack, ABombUnpacksToNoMoreThanAsked) {
    const std::string zeros(8u << 20, '\0');
    ZipBuilder zip;
    zip.add("pack.mcmeta", kMeta);
    zip.add("assets/minecraft/honest", zeros, {.deflate = true});
    zip.add("assets/minecraft/lying", zeros, {.deflate = true, .claimed_size = 10});
    zip.add("assets/minecraft/wrong", "abc", {.wrong_crc = true});
    PackReport report;
    const auto pack = zip_of(zip, report);
    ASSERT_LT(zip.bytes().size(), 100000u);
    EXPECT_EQ(pack->read("minecraft/honest", 1u << 20).error().code, ErrorCode::limit);
    EXPECT_FALSE(pack->read("minecraft/lying", 1u << 20));
    EXPECT_EQ(pack->read("minecraft/wrong", 1u << 20).error().code, ErrorCode::damaged);
    EXPECT_EQ(pack->read("minecraft/honest", 8u << 20)->size(), zeros.size());
}

TEST(ResourcePack, WhatIsNoPackSaysSo) {
    PackReport report;
    test::TempFolder folder;
    EXPECT_EQ(ResourcePack::open(folder.path() / "none", report).error().code, ErrorCode::not_found);
    EXPECT_EQ(ResourcePack::open(folder.path(), report).error().code, ErrorCode::damaged);
    put(folder.path() / "text.zip", "this is no zip");
    EXPECT_EQ(ResourcePack::open(folder.path() / "text.zip", report).error().code, ErrorCode::damaged);
    put(folder.path() / "pack.mcmeta", "{ \"pack\": ");
    const auto broken = ResourcePack::open(folder.path(), report);
    EXPECT_EQ(broken.error().code, ErrorCode::damaged);
    EXPECT_EQ(parse_pack_mcmeta(view_of(R"({"pack":{"min_format":[65,1],"max_format":70}})"), "p")->format, 65);
    EXPECT_FALSE(parse_pack_mcmeta(view_of(R"({"pack":3})"), "p"));
    EXPECT_EQ(parse_pack_mcmeta(view_of(std::string(100000, '[')), "p").error().code, ErrorCode::limit);
}

TEST(PackStack, TheLaterCoversTheEarlierAndABrokenFileLetsThroughWhatIsBelow) {
    PackReport report;
    ZipBuilder low, high;
    low.add("pack.mcmeta", kMeta), high.add("pack.mcmeta", kMeta);
    low.add("assets/minecraft/a", "low"), low.add("assets/minecraft/b", "low"), low.add("assets/minecraft/c", "low");
    high.add("assets/minecraft/a", "high"), high.add("assets/minecraft/c", "high", {.wrong_crc = true});
    PackStack stack;
    stack.add(zip_of(low, report));
    stack.add(zip_of(high, report));
    const auto read = [&](const char* name) {
        return text(Result<Bytes>(stack.read(name, 100, report).value_or(Bytes{})));
    };
    EXPECT_EQ(read("minecraft/a"), "high");
    EXPECT_EQ(read("minecraft/b"), "low");
    EXPECT_EQ(report.problems, 0u);
    EXPECT_EQ(read("minecraft/c"), "low");
    EXPECT_EQ(report.problems, 1u);
    EXPECT_FALSE(stack.read("minecraft/d", 100, report));
}

} // namespace vitrail
