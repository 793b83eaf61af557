#include "formats/resource_pack.h"

#include "formats/json_bounds.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

namespace vitrail {

namespace fs = std::filesystem;

struct ResourcePack::Zip {
    std::mutex mutex; // libzip reads one file of an archive at a time
    Bytes bytes;      // of an archive in memory; outlives it
    zip_t* archive = nullptr;
    ~Zip() {
        if (archive) zip_discard(archive);
    }
};

// A path inside a pack: parts of printable bytes without . and .., no root, no drive, no backslash.
static bool sound_path(std::string_view path) {
    if (path.empty() || path.size() > ResourcePack::kMaxPathBytes) return false;
    for (const char c : path)
        if (u8(c) < 0x20 || c == '\\' || c == ':' || u8(c) == 0x7f) return false;
    for (std::size_t from = 0; from <= path.size();) {
        const std::size_t to = std::min(path.find('/', from), path.size());
        const std::string_view part = path.substr(from, to - from);
        if (part.empty() || part == "." || part == "..") return false;
        from = to + 1;
    }
    return true;
}

ResourcePack::ResourcePack() = default;
ResourcePack::~ResourcePack() = default;

Result<std::shared_ptr<const ResourcePack>> ResourcePack::open(const fs::path& path, PackReport& report) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (error || !fs::exists(status))
        return fail(ErrorCode::not_found, fmt::format("{}: no such resource pack", path.string()));
    std::shared_ptr<ResourcePack> pack(new ResourcePack);
    fs::path named = path.lexically_normal();
    if (!named.has_filename()) named = named.parent_path();
    pack->info_.name = named.filename().string();
    if (fs::is_directory(status)) {
        VX_TRY(pack->list_folder(path, report));
    } else {
        if (const auto size = fs::file_size(path, error); error || size > kMaxPackBytes)
            return fail(
                error ? ErrorCode::io : ErrorCode::limit,
                fmt::format("{}: {}", path.string(), error ? error.message() : "too large for a resource pack"));
        int code = 0;
        pack->zip_ = std::make_unique<Zip>();
        pack->zip_->archive = zip_open(path.c_str(), ZIP_RDONLY, &code);
        if (!pack->zip_->archive) {
            zip_error_t reason;
            zip_error_init_with_code(&reason, code);
            const std::string why = zip_error_strerror(&reason);
            zip_error_fini(&reason);
            return fail(
                code == ZIP_ER_OPEN || code == ZIP_ER_READ ? ErrorCode::io : ErrorCode::damaged,
                fmt::format("{}: is no resource pack, neither a folder nor a sound zip: {}", path.string(), why));
        }
        VX_TRY(pack->list_zip(report));
    }
    if (const auto done = pack->finish(report); !done)
        return fail(done.error().code, fmt::format("{}: {}", path.string(), done.error().message));
    return pack;
}

Result<std::shared_ptr<const ResourcePack>> ResourcePack::from_zip(Bytes bytes, std::string name, PackReport& report) {
    if (bytes.size() > kMaxPackBytes) return fail(ErrorCode::limit, name + ": too large for a resource pack");
    std::shared_ptr<ResourcePack> pack(new ResourcePack);
    pack->info_.name = std::move(name);
    pack->zip_ = std::make_unique<Zip>();
    pack->zip_->bytes = std::move(bytes);
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source =
        zip_source_buffer_create(pack->zip_->bytes.data(), pack->zip_->bytes.size(), 0 /* we keep the bytes */, &error);
    if (source) {
        pack->zip_->archive = zip_open_from_source(source, ZIP_RDONLY, &error);
        if (!pack->zip_->archive) zip_source_free(source);
    }
    zip_error_fini(&error);
    if (!pack->zip_->archive) return fail(ErrorCode::damaged, pack->info_.name + ": no zip");
    VX_TRY(pack->list_zip(report));
    if (const auto done = pack->finish(report); !done)
        return fail(done.error().code, fmt::format("{}: {}", pack->info_.name, done.error().message));
    return pack;
}

Result<> ResourcePack::list_folder(const fs::path& root, PackReport& report) {
    std::error_code error;
    u64 links = 0, odd = 0, seen = 0;
    fs::recursive_directory_iterator it(root, fs::directory_options::skip_permission_denied, error), end;
    if (error) return fail(ErrorCode::io, fmt::format("{}: {}", root.string(), error.message()));
    for (; it != end; it.increment(error)) {
        if (error) break;
        if (++seen > kMaxFiles)
            return fail(ErrorCode::limit, fmt::format("{}: more than {} files", root.string(), kMaxFiles));
        const fs::file_status status = it->symlink_status(error);
        if (error || fs::is_symlink(status)) { // a link could lead anywhere
            links += !error;
            it.disable_recursion_pending();
            continue;
        }
        if (it.depth() > 16) it.disable_recursion_pending();
        if (!fs::is_regular_file(status)) continue;
        std::string name = it->path().lexically_relative(root).generic_string();
        if (!sound_path(name)) {
            ++odd;
            continue;
        }
        files_.emplace(std::move(name), Place{0, it->path()});
    }
    if (error) report.say(fmt::format("{}: {}", info_.name, error.message()));
    if (links) report.say(fmt::format("{}: {} links are not followed", info_.name, links));
    if (odd) report.say(fmt::format("{}: {} files with odd names are left out", info_.name, odd));
    return {};
}

Result<> ResourcePack::list_zip(PackReport& report) {
    const zip_int64_t count = zip_get_num_entries(zip_->archive, 0);
    if (count < 0 || u64(count) > kMaxFiles)
        return fail(ErrorCode::limit, fmt::format("{}: more than {} files", info_.name, kMaxFiles));
    u64 odd = 0;
    for (zip_uint64_t i = 0; i < zip_uint64_t(count); ++i) {
        const char* raw = zip_get_name(zip_->archive, i, 0);
        if (!raw) {
            ++odd;
            continue;
        }
        const std::string_view name = raw;
        if (name.ends_with('/')) continue; // a folder
        if (!sound_path(name)) {
            ++odd;
            continue;
        }
        files_.emplace(std::string(name), Place{i, {}}); // the first of two equal names
    }
    if (odd)
        report.say(
            fmt::format("{}: {} files whose names lead out of the pack or are no names are left out", info_.name, odd));
    return {};
}

Result<> ResourcePack::finish(PackReport& report) {
    // Some archives hold one folder that holds the pack.
    std::string above;
    if (!files_.contains("pack.mcmeta")) {
        for (const auto& [path, place] : files_)
            if (const std::size_t slash = path.find('/');
                slash != std::string::npos && path.compare(slash, std::string::npos, "/pack.mcmeta") == 0) {
                above = path.substr(0, slash + 1);
                break;
            }
        if (above.empty()) return fail(ErrorCode::damaged, "is no resource pack: there is no pack.mcmeta");
    }
    VX_TRY_ASSIGN(const Bytes text, read_place(files_.at(above + "pack.mcmeta"), kMaxJsonBytes));
    VX_TRY_ASSIGN(info_, parse_pack_mcmeta(text, info_.name));

    std::map<std::string, Place, std::less<>> inside;
    const std::string assets = above + "assets/";
    bool any_assets = false;
    for (const auto& [path, place] : files_)
        any_assets |= path.starts_with(assets);
    for (auto& [path, place] : files_) {
        if (any_assets && path.starts_with(assets)) {
            const std::string below = path.substr(assets.size());
            if (below.find('/') != std::string::npos) inside.emplace(below, std::move(place));
        } else if (!any_assets && path.starts_with(above) &&
                   (path.compare(above.size(), 9, "textures/") == 0 || path.compare(above.size(), 7, "models/") == 0 ||
                    path.compare(above.size(), 12, "blockstates/") == 0)) {
            inside.emplace("minecraft/" + path.substr(above.size()), std::move(place));
        }
    }
    files_ = std::move(inside);
    if (files_.empty()) report.say(info_.name + ": holds no assets");
    return {};
}

std::vector<std::string> ResourcePack::list(std::string_view prefix, std::string_view suffix) const {
    std::vector<std::string> out;
    for (auto it = files_.lower_bound(prefix); it != files_.end() && it->first.starts_with(prefix); ++it)
        if (it->first.ends_with(suffix)) out.push_back(it->first);
    return out;
}

Result<Bytes> ResourcePack::read(std::string_view path, std::size_t most) const {
    const auto it = files_.find(path);
    if (it == files_.end()) return fail(ErrorCode::not_found, fmt::format("{}: has no {}", info_.name, path));
    Result<Bytes> bytes = read_place(it->second, most);
    if (!bytes) return fail(bytes.error().code, fmt::format("{}: {}: {}", info_.name, path, bytes.error().message));
    return bytes;
}

static Result<Bytes> read_file_within(const fs::path& file, std::size_t most) {
    const int fd = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0) return fail(ErrorCode::io, std::strerror(errno));
    struct stat info {};
    if (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode)) {
        ::close(fd);
        return fail(ErrorCode::io, "is no file");
    }
    if (u64(info.st_size) > most) {
        ::close(fd);
        return fail(ErrorCode::limit, fmt::format("{} bytes are too many", u64(info.st_size)));
    }
    Bytes bytes(std::size_t(info.st_size));
    std::size_t have = 0;
    while (have < bytes.size()) {
        const ssize_t n = ::read(fd, bytes.data() + have, bytes.size() - have);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) break;
        have += std::size_t(n);
    }
    ::close(fd);
    if (have < bytes.size()) return fail(ErrorCode::io, "cannot be read to its end");
    return bytes;
}

Result<Bytes> ResourcePack::read_place(const Place& place, std::size_t most) const {
    if (!zip_) return read_file_within(place.file, most);
    std::lock_guard lock(zip_->mutex);
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_stat_index(zip_->archive, place.index, 0, &stat) != 0)
        return fail(ErrorCode::damaged, zip_strerror(zip_->archive));
    if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) && stat.encryption_method != ZIP_EM_NONE)
        return fail(ErrorCode::unsupported, "is encrypted");
    if (!(stat.valid & ZIP_STAT_SIZE) || stat.size > most)
        return fail(ErrorCode::limit, fmt::format("{} bytes are too many", stat.size));
    zip_file_t* file = zip_fopen_index(zip_->archive, place.index, 0);
    if (!file) return fail(ErrorCode::damaged, zip_strerror(zip_->archive));
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> guard(file, zip_fclose);
    // The size is only what the header claims: memory grows with what really comes out, and one byte more is an error.
    Bytes bytes;
    u8 block[16384];
    for (;;) {
        const zip_int64_t n = zip_fread(file, block, sizeof block);
        if (n < 0) return fail(ErrorCode::damaged, zip_file_strerror(file));
        if (n == 0) break;
        if (bytes.size() + u64(n) > most) return fail(ErrorCode::limit, "unpacks to more than it says");
        bytes.insert(bytes.end(), block, block + n);
    }
    return bytes;
}

// A text component: a string, an object with "text" and "extra", or a list of them.
static void plain_text(const nlohmann::json& value, std::string& out, int depth) {
    if (depth > 8 || out.size() > 256) return;
    if (value.is_string()) {
        out += value.get_ref<const std::string&>();
    } else if (value.is_array()) {
        for (const auto& part : value)
            plain_text(part, out, depth + 1);
    } else if (value.is_object()) {
        for (const char* key : {"text", "fallback", "extra"})
            if (const auto it = value.find(key); it != value.end()) plain_text(*it, out, depth + 1);
    }
}

Result<PackInfo> parse_pack_mcmeta(ByteView text, std::string name) {
    VX_TRY_ASSIGN(const nlohmann::json root, parse_json(text));
    const auto pack = root.find("pack");
    if (!root.is_object() || pack == root.end() || !pack->is_object())
        return fail(ErrorCode::damaged, "pack.mcmeta has no \"pack\"");
    PackInfo info;
    info.name = std::move(name);
    // From 1.21.9 a pack may give a range instead, whole numbers or [major, minor].
    for (const char* key : {"pack_format", "min_format"}) {
        auto it = pack->find(key);
        if (it == pack->end()) continue;
        const nlohmann::json& value = it->is_array() && !it->empty() ? it->front() : *it;
        if (value.is_number_integer()) {
            info.format = i32(std::clamp<i64>(value.get<i64>(), 0, 1 << 20));
            break;
        }
    }
    if (const auto it = pack->find("description"); it != pack->end()) plain_text(*it, info.description, 0);
    std::replace_if(
        info.description.begin(), info.description.end(), [](char c) { return u8(c) < 0x20; }, ' ');
    info.description.resize(std::min<std::size_t>(info.description.size(), 256));
    return info;
}

const ResourcePack* PackStack::find(std::string_view path) const {
    for (auto it = packs_.rbegin(); it != packs_.rend(); ++it)
        if ((*it)->contains(path)) return it->get();
    return nullptr;
}

std::optional<Bytes> PackStack::read(std::string_view path, std::size_t most, PackReport& report) const {
    for (auto it = packs_.rbegin(); it != packs_.rend(); ++it) {
        if (!(*it)->contains(path)) continue;
        Result<Bytes> bytes = (*it)->read(path, most);
        if (bytes) return std::move(*bytes);
        report.say(bytes.error().message);
    }
    return std::nullopt;
}

Result<ResourceName> parse_resource_name(std::string_view text) {
    ResourceName name;
    std::string_view path = text;
    if (const std::size_t colon = text.find(':'); colon != std::string_view::npos) {
        name.space = std::string(text.substr(0, colon));
        path = text.substr(colon + 1);
        if (name.space.empty()) name.space = "minecraft";
        if (name.space.find('/') != std::string::npos) path = {};
    }
    if (!sound_path(path) || !sound_path(name.space))
        return fail(ErrorCode::invalid_argument, fmt::format("'{}' is no name of a resource", text.substr(0, 80)));
    name.path = std::string(path);
    return name;
}

std::string ResourceName::file(std::string_view kind, std::string_view suffix) const {
    return fmt::format("{}/{}/{}{}", space, kind, path, suffix);
}

} // namespace vitrail
