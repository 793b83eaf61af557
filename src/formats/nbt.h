// NBT, Minecraft's tagged binary form, big-endian as files hold it (docs/formats/minecraft.md).
//
//     nbt::Document doc;                       // reuse it: its arena keeps its memory from chunk to chunk
//     if (!doc.parse(bytes)) log(doc.error()->message);
//     i64 version = doc.root()["DataVersion"].integer(0);   // also after an error: what was read stays readable
//     for (nbt::Tag entity : doc.root()["Entities"]) keep(nbt::document_of(entity));
//
// Strings stay the modified UTF-8 bytes they are. Tags are views into the parsed bytes: they live as long as these do.
#pragma once

#include "base/bytes.h"
#include "base/result.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vitrail::nbt {

enum class Type : u8 {
    end,
    byte,
    short_int,
    int32,
    int64,
    float32,
    float64,
    byte_array,
    string,
    list,
    compound,
    int_array,
    long_array
};
inline constexpr u8 kTypeCount = 13;
inline constexpr std::size_t kMaxDepth = 512;      // Minecraft's own bound
inline constexpr std::size_t kMaxNodes = 1u << 21; // 56 MiB of arena
inline constexpr std::size_t kMaxBytes = 1u << 30;

namespace detail {
struct Node {
    u32 name_at = 0, at = 0, size = 0; // payload: bytes [at, at + size)
    u32 count = 0;                     // elements of a list or array, children of a compound, bytes of a string
    u32 next = 0;                      // next sibling, 0 where last; the first child follows its parent
    u16 name_size = 0;
    Type type = Type::end, element = Type::end;
    bool complete = false, has_children = false;
};
} // namespace detail

// One tag. A Tag of nothing (not found) is false and answers every question with the default.
class Tag {
public:
    Tag() = default;
    explicit operator bool() const { return node_ != nullptr; }
    Type type() const { return node_ ? node_->type : Type::end; }
    bool is(Type t) const { return type() == t; }
    std::string_view name() const { return node_ ? chars(node_->name_at, node_->name_size) : std::string_view(); }
    std::size_t size() const { return node_ ? node_->count : 0; }
    Type element_type() const { return node_ ? node_->element : Type::end; }
    // False where the input ended or broke inside this tag.
    bool complete() const { return node_ && node_->complete; }
    // The payload as stored, without type and name.
    ByteView payload() const { return node_ ? ByteView(data_ + node_->at, node_->size) : ByteView(); }

    // A compound's first child of that name.
    Tag operator[](std::string_view name) const;
    bool has(std::string_view name) const { return bool((*this)[name]); }
    Tag first_child() const { return node_ && node_->has_children ? Tag(nodes_, data_, node_ + 1) : Tag(); }
    Tag next_sibling() const { return node_ && node_->next ? Tag(nodes_, data_, nodes_ + node_->next) : Tag(); }

    // Any number tag, floats rounded toward zero and clamped.
    i64 integer(i64 otherwise = 0) const;
    double number(double otherwise = 0) const;
    std::string_view text(std::string_view otherwise = {}) const {
        return is(Type::string) ? chars(node_->at + 2, node_->count) : otherwise;
    }
    // Bytes of a byte array; empty for other types.
    ByteView bytes() const { return is(Type::byte_array) ? ByteView(data_ + node_->at + 4, node_->count) : ByteView(); }
    // Element of an array or of a list of numbers; 0 out of range. A list of numbers has no child tags.
    i64 integer_at(std::size_t i) const;
    double number_at(std::size_t i) const;
    // A long array's raw big-endian elements, 8 bytes each; empty for other types.
    ByteView longs() const {
        return is(Type::long_array) ? ByteView(data_ + node_->at + 4, node_->size - 4) : ByteView();
    }

    class Iterator;
    Iterator begin() const;
    Iterator end() const;

private:
    friend class Document;
    Tag(const detail::Node* nodes, const u8* data, const detail::Node* node)
        : nodes_(nodes)
        , data_(data)
        , node_(node) {}
    std::string_view chars(std::size_t at, std::size_t size) const {
        return {reinterpret_cast<const char*>(data_) + at, size};
    }
    bool element(std::size_t i, Type& type, const u8*& at) const;
    const detail::Node* nodes_ = nullptr;
    const u8* data_ = nullptr;
    const detail::Node* node_ = nullptr;
};

class Tag::Iterator {
public:
    explicit Iterator(Tag tag)
        : tag_(tag) {}
    Tag operator*() const { return tag_; }
    Iterator& operator++() {
        tag_ = tag_.next_sibling();
        return *this;
    }
    bool operator!=(const Iterator& other) const { return bool(tag_) != bool(other.tag_); }

private:
    Tag tag_;
};
inline Tag::Iterator Tag::begin() const {
    return Iterator(first_child());
}
inline Tag::Iterator Tag::end() const {
    return Iterator(Tag());
}

class Document {
public:
    // Parses one named root compound; bytes after it are ignored. False where the input breaks off or is wrong: `error`
    // says how, and `root` holds all that was read before that place.
    bool parse(ByteView bytes);
    Tag root() const { return nodes_.empty() ? Tag() : Tag(nodes_.data(), data_, nodes_.data()); }
    const std::optional<Error>& error() const { return error_; }
    std::size_t bytes_used() const { return used_; }

private:
    std::vector<detail::Node> nodes_;
    std::optional<Error> error_;
    const u8* data_ = nullptr;
    std::size_t used_ = 0;
};

// A compound alone, as a document of its own with an empty root name; empty where the tag is no complete compound.
Bytes document_of(Tag compound);

// Builds NBT. Inside a list names are not written and `name` is ignored.
class Writer {
public:
    Writer& begin_compound(std::string_view name = {});
    Writer& end_compound();
    // Exactly `count` values of that type must follow before end_list.
    Writer& begin_list(std::string_view name, Type element, u32 count);
    Writer& end_list();
    Writer& put_byte(std::string_view name, i8 v);
    Writer& put_short(std::string_view name, i16 v);
    Writer& put_int(std::string_view name, i32 v);
    Writer& put_long(std::string_view name, i64 v);
    Writer& put_float(std::string_view name, float v);
    Writer& put_double(std::string_view name, double v);
    Writer& put_string(std::string_view name, std::string_view v); // at most 65535 bytes
    Writer& put_bytes(std::string_view name, ByteView v);
    Writer& put_ints(std::string_view name, std::span<const i32> v);
    Writer& put_longs(std::string_view name, std::span<const u64> v);
    // A tag of a document under its payload as stored.
    Writer& put_tag(std::string_view name, Tag tag);
    Bytes take() { return std::move(out_); }

private:
    void head(Type type, std::string_view name);
    void big(u64 v, int bytes);
    Bytes out_;
    std::vector<bool> in_list_;
};

} // namespace vitrail::nbt
