#include "client/pack_list.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace vitrail::client;
namespace fs = std::filesystem;

namespace {

struct PackFolder {
    fs::path path = fs::temp_directory_path() / ("vitrail_pack_list_" + std::to_string(getpid()));
    PackFolder() {
        fs::remove_all(path);
        fs::create_directories(path / "Cobbled" / "assets");
        fs::create_directories(path / "bare" / "textures");
        fs::create_directories(path / "holiday photos");
        std::ofstream(path / "Amber.zip") << "zip";
        std::ofstream(path / "readme.txt") << "no pack";
    }
    ~PackFolder() { fs::remove_all(path); }
    std::string at(const char* name) const { return (path / name).string(); }
};

std::vector<std::string> names(const std::vector<PackEntry>& list) {
    std::vector<std::string> out;
    for (const PackEntry& e : list)
        out.push_back((e.on ? "+" : e.missing ? "?" : "-") + e.name);
    return out;
}
using Names = std::vector<std::string>;

} // namespace

TEST(PackList, ChosenFirstTheCoveringOnTopThenTheFolder) {
    const PackFolder folder;
    EXPECT_EQ(names(list_packs(folder.path, {})), (Names{"-Amber.zip", "-Cobbled", "-bare"}));
    const std::vector<std::string> chosen{folder.at("bare"), "/somewhere/else/Mine.zip", folder.at("Cobbled") + "/"};
    const auto list = list_packs(folder.path, chosen);
    EXPECT_EQ(names(list), (Names{"+Cobbled", "+Mine.zip", "+bare", "-Amber.zip"}));
    EXPECT_TRUE(list[1].missing);
    EXPECT_FALSE(list[0].missing);
    EXPECT_EQ(packs_in_use(list), chosen); // nothing chosen is lost or spelled anew
}

TEST(PackList, AFolderThatIsNotThereHasNone) {
    EXPECT_TRUE(list_packs("/nowhere/at/all", {}).empty());
    EXPECT_EQ(list_packs("", {"/a/b.zip"}).size(), 1u);
}

TEST(PackList, TurnedOnItLiesUnderTheOthersTurnedOffItLeavesThem) {
    const PackFolder folder;
    auto list = list_packs(folder.path, {folder.at("bare")});
    toggle_pack(list, 2); // Cobbled
    EXPECT_EQ(names(list), (Names{"+bare", "+Cobbled", "-Amber.zip"}));
    EXPECT_EQ(packs_in_use(list), (Names{folder.at("Cobbled"), folder.at("bare")}));
    toggle_pack(list, 0);
    EXPECT_EQ(names(list), (Names{"+Cobbled", "-bare", "-Amber.zip"}));
    toggle_pack(list, 17);
    EXPECT_EQ(list.size(), 3u);
}

TEST(PackList, OrderChangesAmongThoseInUseAlone) {
    const PackFolder folder;
    auto list = list_packs(folder.path, {folder.at("bare"), folder.at("Cobbled")});
    EXPECT_EQ(names(list), (Names{"+Cobbled", "+bare", "-Amber.zip"}));
    move_pack(list, 0, true);  // at the top already
    move_pack(list, 1, false); // at the bottom already
    move_pack(list, 2, true);  // not in use
    EXPECT_EQ(names(list), (Names{"+Cobbled", "+bare", "-Amber.zip"}));
    move_pack(list, 1, true);
    EXPECT_EQ(packs_in_use(list), (Names{folder.at("Cobbled"), folder.at("bare")}));
    move_pack(list, 0, false);
    EXPECT_EQ(packs_in_use(list), (Names{folder.at("bare"), folder.at("Cobbled")}));
}
