#include "client/pack_list.h"

#include <algorithm>
#include <utility>

namespace vitrail::client {

namespace fs = std::filesystem;

static std::string name_of(const fs::path& path) {
    const fs::path plain = path.lexically_normal();
    return (plain.has_filename() ? plain : plain.parent_path()).filename().string();
}

static bool may_be_pack(const fs::directory_entry& entry) {
    std::error_code ignored;
    if (entry.is_regular_file(ignored)) return entry.path().extension() == ".zip";
    if (!entry.is_directory(ignored)) return false;
    for (const char* part : {"pack.mcmeta", "assets", "textures"})
        if (fs::exists(entry.path() / part, ignored)) return true;
    return false;
}

static bool same_place(const fs::path& a, const fs::path& b) {
    std::error_code error;
    return a.lexically_normal() == b.lexically_normal() || fs::equivalent(a, b, error);
}

std::vector<PackEntry> list_packs(const fs::path& folder, const std::vector<std::string>& chosen) {
    std::vector<PackEntry> list;
    std::error_code error;
    for (auto path = chosen.rbegin(); path != chosen.rend(); ++path)
        list.push_back({*path, name_of(*path), true, !fs::exists(*path, error)});
    std::vector<PackEntry> others;
    fs::directory_iterator at(folder, error);
    for (; !error && at != fs::directory_iterator() && others.size() < kPacksListed; at.increment(error)) {
        const fs::path& path = at->path();
        const auto here = [&](const PackEntry& e) { return same_place(e.path, path); };
        if (may_be_pack(*at) && std::none_of(list.begin(), list.end(), here))
            others.push_back({path.string(), name_of(path), false, false});
    }
    std::sort(others.begin(), others.end(), [](const PackEntry& a, const PackEntry& b) { return a.name < b.name; });
    list.insert(list.end(), others.begin(), others.end());
    return list;
}

std::vector<std::string> packs_in_use(const std::vector<PackEntry>& list) {
    std::vector<std::string> paths;
    for (auto entry = list.rbegin(); entry != list.rend(); ++entry)
        if (entry->on) paths.push_back(entry->path);
    return paths;
}

void toggle_pack(std::vector<PackEntry>& list, std::size_t index) {
    if (index >= list.size()) return;
    PackEntry entry = std::move(list[index]);
    list.erase(list.begin() + std::ptrdiff_t(index));
    entry.on = !entry.on;
    // Behind the last in use, either way.
    const auto after = std::find_if(list.begin(), list.end(), [](const PackEntry& e) { return !e.on; });
    list.insert(after, std::move(entry));
}

void move_pack(std::vector<PackEntry>& list, std::size_t index, bool up) {
    if (index >= list.size() || !list[index].on) return;
    const std::size_t to = up ? index - 1 : index + 1; // wraps below 0: out of range
    if (to < list.size() && list[to].on) std::swap(list[index], list[to]);
}

} // namespace vitrail::client
