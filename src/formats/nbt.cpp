#include "formats/nbt.h"

#include "base/assert.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace vitrail::nbt {

static u16 read16(const u8* p) {
    return u16(p[0] << 8 | p[1]);
}
static u32 read32(const u8* p) {
    u32 v;
    std::memcpy(&v, p, 4);
    return __builtin_bswap32(v);
}
static u64 read64(const u8* p) {
    u64 v;
    std::memcpy(&v, p, 8);
    return __builtin_bswap64(v);
}

// Bytes of a number tag's payload; 0 for the others.
static u32 fixed_size(Type type) {
    static constexpr u8 kSize[kTypeCount] = {0, 1, 2, 4, 8, 4, 8, 0, 0, 0, 0, 0, 0};
    return kSize[u8(type)];
}
static u32 array_element_size(Type type) {
    return type == Type::byte_array ? 1 : type == Type::int_array ? 4 : type == Type::long_array ? 8 : 0;
}

Tag Tag::operator[](std::string_view name) const {
    if (!is(Type::compound)) return {};
    for (Tag child : *this)
        if (child.name() == name) return child;
    return {};
}

static i64 integer_from(Type type, const u8* p, i64 otherwise) {
    auto rounded = [&](double v) -> i64 {
        if (v != v) return otherwise;
        if (v >= 0x1p63) return INT64_MAX;
        return v <= -0x1p63 ? INT64_MIN : i64(v);
    };
    switch (type) {
    case Type::byte:
        return i8(p[0]);
    case Type::short_int:
        return i16(read16(p));
    case Type::int32:
        return i32(read32(p));
    case Type::int64:
        return i64(read64(p));
    case Type::float32:
        return rounded(std::bit_cast<float>(read32(p)));
    case Type::float64:
        return rounded(std::bit_cast<double>(read64(p)));
    default:
        return otherwise;
    }
}
static double number_from(Type type, const u8* p, double otherwise) {
    if (type == Type::float32) return std::bit_cast<float>(read32(p));
    if (type == Type::float64) return std::bit_cast<double>(read64(p));
    return fixed_size(type) ? double(integer_from(type, p, 0)) : otherwise;
}

i64 Tag::integer(i64 otherwise) const {
    return node_ ? integer_from(node_->type, data_ + node_->at, otherwise) : otherwise;
}
double Tag::number(double otherwise) const {
    return node_ ? number_from(node_->type, data_ + node_->at, otherwise) : otherwise;
}

bool Tag::element(std::size_t i, Type& type, const u8*& at) const {
    if (!node_ || i >= node_->count) return false;
    u32 size = 0, head = 4;
    switch (node_->type) {
    case Type::byte_array:
        type = Type::byte, size = 1;
        break;
    case Type::int_array:
        type = Type::int32, size = 4;
        break;
    case Type::long_array:
        type = Type::int64, size = 8;
        break;
    case Type::list:
        type = node_->element, size = fixed_size(type), head = 5;
        break;
    default:
        break;
    }
    if (size == 0) return false;
    at = data_ + node_->at + head + i * size;
    return true;
}
i64 Tag::integer_at(std::size_t i) const {
    Type t;
    const u8* p;
    return element(i, t, p) ? integer_from(t, p, 0) : 0;
}
double Tag::number_at(std::size_t i) const {
    Type t;
    const u8* p;
    return element(i, t, p) ? number_from(t, p, 0) : 0;
}

namespace {

static_assert(sizeof(detail::Node) == 28);

// An open list or compound.
struct Frame {
    u32 node, last_child;
    u32 left; // list elements still to come
};

} // namespace

bool Document::parse(ByteView bytes) {
    nodes_.clear();
    error_.reset();
    data_ = bytes.data();
    used_ = 0;
    auto wrong = [&](ErrorCode code, const char* what) {
        error_ = Error{code, std::string("NBT: ") + what + " at byte " + std::to_string(used_)};
        return false;
    };
    if (bytes.size() > kMaxBytes) return wrong(ErrorCode::limit, "input is too long");
    const u8* const d = bytes.data();
    const u32 end = u32(bytes.size());
    if (end < 3) return wrong(ErrorCode::damaged, "input ends");
    if (Type(d[0]) != Type::compound) return wrong(ErrorCode::damaged, "root is no compound");

    std::array<Frame, kMaxDepth> stack;
    std::size_t depth = 0;
    u32 at = 0;
    Type type = Type::compound;
    bool named = true;

    // Closes what is still open, so that every view stays inside the input.
    auto stop = [&](ErrorCode code, const char* what) {
        used_ = at;
        for (std::size_t i = 0; i < depth; ++i) {
            detail::Node& n = nodes_[stack[i].node];
            n.size = at - n.at;
            // Outer lists hold the element that is open; the innermost lost the one that broke.
            if (n.type == Type::list) n.count -= stack[i].left + (i + 1 == depth ? 1 : 0);
        }
        return wrong(code, what);
    };

    at = 1;
    for (;;) {
        // One tag: name where named, then payload.
        detail::Node node;
        node.type = type;
        const u32 tag_at = at;
        bool ok = true;
        if (named) {
            ok = end - at >= 2;
            if (ok) {
                node.name_size = read16(d + at);
                node.name_at = at + 2;
                at += 2;
                ok = end - at >= node.name_size;
                if (ok) at += node.name_size;
            }
        }
        node.at = at;
        bool opens = false;
        if (ok) {
            const u32 room = end - at;
            if (const u32 fixed = fixed_size(type)) {
                ok = room >= fixed;
                node.size = fixed;
            } else if (const u32 each = array_element_size(type)) {
                ok = room >= 4;
                if (ok) {
                    node.count = read32(d + at);
                    ok = node.count <= (room - 4) / each;
                    node.size = ok ? 4 + node.count * each : 0;
                }
            } else if (type == Type::string) {
                ok = room >= 2;
                if (ok) {
                    node.count = read16(d + at);
                    ok = room - 2 >= node.count;
                    node.size = 2 + node.count;
                }
            } else if (type == Type::list) {
                ok = room >= 5;
                if (ok) {
                    if (d[at] >= kTypeCount) {
                        at = tag_at;
                        return stop(ErrorCode::damaged, "unknown tag type");
                    }
                    node.element = Type(d[at]);
                    const i32 count = i32(read32(d + at + 1));
                    node.count = count > 0 && node.element != Type::end ? u32(count) : 0;
                    node.size = 5;
                    if (const u32 bytes_each = fixed_size(node.element)) {
                        ok = node.count <= (room - 5) / bytes_each;
                        node.size = ok ? 5 + node.count * bytes_each : 0;
                    } else if (node.count > 0) {
                        opens = true;
                    }
                }
            } else { // compound
                opens = true;
            }
        }
        if (!ok) {
            at = tag_at;
            return stop(ErrorCode::damaged, "input ends inside a tag");
        }
        if (nodes_.size() >= kMaxNodes) {
            at = tag_at;
            return stop(ErrorCode::limit, "too many tags");
        }
        if (opens && depth == kMaxDepth) {
            at = tag_at;
            return stop(ErrorCode::limit, "nested too deep");
        }
        const u32 index = u32(nodes_.size());
        node.complete = !opens;
        nodes_.push_back(node);
        if (depth > 0) {
            Frame& top = stack[depth - 1];
            detail::Node& parent = nodes_[top.node];
            if (parent.has_children) nodes_[top.last_child].next = index;
            parent.has_children = true;
            top.last_child = index;
            if (parent.type == Type::compound) ++parent.count;
        }
        at += opens ? (type == Type::list ? 5 : 0) : node.size;
        if (opens) stack[depth++] = {index, 0, type == Type::list ? node.count : 0};

        // What comes next: a list's next element, a compound's next child, or the end of what is open.
        for (;;) {
            if (depth == 0) {
                used_ = at;
                return true;
            }
            Frame& top = stack[depth - 1];
            if (detail::Node& open = nodes_[top.node]; open.type == Type::list) {
                if (top.left > 0) {
                    --top.left;
                    type = open.element;
                    named = false;
                    break;
                }
            } else {
                if (at == end) return stop(ErrorCode::damaged, "input ends inside a compound");
                if (d[at] >= kTypeCount) return stop(ErrorCode::damaged, "unknown tag type");
                type = Type(d[at++]);
                if (type != Type::end) {
                    named = true;
                    break;
                }
            }
            detail::Node& closed = nodes_[top.node];
            closed.size = at - closed.at;
            closed.complete = true;
            --depth;
        }
    }
}

Bytes document_of(Tag compound) {
    Bytes out;
    if (!compound.is(Type::compound) || !compound.complete()) return out;
    const ByteView payload = compound.payload();
    out.reserve(payload.size() + 3);
    out.assign({u8(Type::compound), 0, 0});
    out.insert(out.end(), payload.begin(), payload.end());
    return out;
}

void Writer::big(u64 v, int bytes) {
    for (int i = bytes - 1; i >= 0; --i)
        out_.push_back(u8(v >> (8 * i)));
}
void Writer::head(Type type, std::string_view name) {
    if (!in_list_.empty() && in_list_.back()) return;
    VX_ASSERT(name.size() <= 65535);
    out_.push_back(u8(type));
    big(name.size(), 2);
    out_.insert(out_.end(), name.begin(), name.end());
}
Writer& Writer::begin_compound(std::string_view name) {
    head(Type::compound, name);
    in_list_.push_back(false);
    return *this;
}
Writer& Writer::end_compound() {
    out_.push_back(0);
    in_list_.pop_back();
    return *this;
}
Writer& Writer::begin_list(std::string_view name, Type element, u32 count) {
    head(Type::list, name);
    out_.push_back(u8(element));
    big(count, 4);
    in_list_.push_back(true);
    return *this;
}
Writer& Writer::end_list() {
    in_list_.pop_back();
    return *this;
}
Writer& Writer::put_byte(std::string_view name, i8 v) {
    head(Type::byte, name);
    big(u8(v), 1);
    return *this;
}
Writer& Writer::put_short(std::string_view name, i16 v) {
    head(Type::short_int, name);
    big(u16(v), 2);
    return *this;
}
Writer& Writer::put_int(std::string_view name, i32 v) {
    head(Type::int32, name);
    big(u32(v), 4);
    return *this;
}
Writer& Writer::put_long(std::string_view name, i64 v) {
    head(Type::int64, name);
    big(u64(v), 8);
    return *this;
}
Writer& Writer::put_float(std::string_view name, float v) {
    head(Type::float32, name);
    big(std::bit_cast<u32>(v), 4);
    return *this;
}
Writer& Writer::put_double(std::string_view name, double v) {
    head(Type::float64, name);
    big(std::bit_cast<u64>(v), 8);
    return *this;
}
Writer& Writer::put_string(std::string_view name, std::string_view v) {
    VX_ASSERT(v.size() <= 65535);
    head(Type::string, name);
    big(v.size(), 2);
    out_.insert(out_.end(), v.begin(), v.end());
    return *this;
}
Writer& Writer::put_bytes(std::string_view name, ByteView v) {
    head(Type::byte_array, name);
    big(v.size(), 4);
    out_.insert(out_.end(), v.begin(), v.end());
    return *this;
}
Writer& Writer::put_ints(std::string_view name, std::span<const i32> v) {
    head(Type::int_array, name);
    big(v.size(), 4);
    for (i32 e : v)
        big(u32(e), 4);
    return *this;
}
Writer& Writer::put_longs(std::string_view name, std::span<const u64> v) {
    head(Type::long_array, name);
    big(v.size(), 4);
    for (u64 e : v)
        big(e, 8);
    return *this;
}
Writer& Writer::put_tag(std::string_view name, Tag tag) {
    VX_ASSERT(tag.complete());
    head(tag.type(), name);
    const ByteView payload = tag.payload();
    out_.insert(out_.end(), payload.begin(), payload.end());
    return *this;
}

} // namespace vitrail::nbt
