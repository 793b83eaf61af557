// One description, many uses: a struct lists its numbered fields once and gets a codec, bounds checks and a debug
// print.
//
//     struct Hello {
//         u32 version = 0;
//         std::string name;
//         static constexpr auto fields = std::tuple{field<1>("version", &Hello::version),
//                                                   field<2>("name", &Hello::name, {.most = 32})};
//     };
//     Bytes bytes = encode_fields(hello);
//     Result<Hello> back = decode_fields<Hello>(bytes);
//
// Wire form (docs/formats/fields.md): each field is a varint key (number << 2 | kind) and its value; kind 0 is a zigzag
// or plain varint, 1 four bytes, 2 a length and that many bytes. Unknown numbers are skipped, missing ones keep their
// default, so formats can grow. A number is never used again for another meaning.
// Supported: bool, integers, enums, float, std::string, Bytes, std::vector of those, structs with `fields`, vectors of
// them.
#pragma once

#include "base/bytes.h"
#include "base/result.h"

#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace vitrail {

struct FieldLimits {
    u64 most = 65536; // strings and byte strings: bytes; vectors: elements
    i64 least_value = std::numeric_limits<i64>::min();
    i64 most_value = std::numeric_limits<i64>::max();
};

template <class S, class T>
struct Field {
    u32 number;
    const char* name;
    T S::*member;
    FieldLimits limits;
};

template <u32 Number, class S, class T>
constexpr Field<S, T> field(const char* name, T S::*member, FieldLimits limits = {}) {
    static_assert(Number > 0);
    return {Number, name, member, limits};
}

namespace detail {

template <class T>
concept HasFields = requires {
    T::fields;
};
template <class T>
concept IntegerLike = std::is_integral_v<T> || std::is_enum_v<T>;
template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};

enum FieldKind : u32 { kVarint = 0, kFixed32 = 1, kBlock = 2 };

template <class T>
constexpr FieldKind field_kind() {
    if constexpr (IntegerLike<T>)
        return kVarint;
    else if constexpr (std::is_same_v<T, float>)
        return kFixed32;
    else
        return kBlock;
}

template <class T>
void encode_value(ByteWriter& out, const T& v);
template <class T>
void decode_value(ByteReader& in, T& v, const FieldLimits& limits, int depth);

template <HasFields T>
void encode_struct(ByteWriter& out, const T& value) {
    std::apply(
        [&](const auto&... f) {
            ((out.put_varint(f.number << 2 | field_kind<std::remove_cvref_t<decltype(value.*f.member)>>()),
              encode_value(out, value.*f.member)),
             ...);
        },
        T::fields);
}

template <class T>
void encode_value(ByteWriter& out, const T& v) {
    if constexpr (std::is_enum_v<T>)
        encode_value(out, std::underlying_type_t<T>(v));
    else if constexpr (std::is_integral_v<T> && std::is_signed_v<T>)
        out.put_svarint(v);
    else if constexpr (std::is_integral_v<T>)
        out.put_varint(v);
    else if constexpr (std::is_same_v<T, float>)
        out.put_f32(v);
    else if constexpr (std::is_same_v<T, std::string>)
        out.put_string(v);
    else if constexpr (std::is_same_v<T, Bytes>)
        out.put_varint(v.size()), out.put_bytes(v);
    else {
        ByteWriter inner;
        if constexpr (IsVector<T>::value)
            for (const auto& e : v)
                encode_value(inner, e);
        else
            encode_struct(inner, v);
        out.put_varint(inner.size());
        out.put_bytes(inner.bytes());
    }
}

template <HasFields T>
void decode_struct(ByteReader& in, T& value, int depth) {
    while (!in.failed() && in.remaining() > 0) {
        const u64 key = in.get_varint();
        bool known = false;
        std::apply(
            [&](const auto&... f) {
                auto one = [&](const auto& g) {
                    if (known || (key >> 2) != g.number) return;
                    known = true;
                    using M = std::remove_cvref_t<decltype(value.*g.member)>;
                    if ((key & 3) != field_kind<M>())
                        in.set_failed();
                    else
                        decode_value(in, value.*g.member, g.limits, depth);
                };
                (one(f), ...);
            },
            T::fields);
        if (known) continue;
        switch (key & 3) {
        case kVarint:
            in.get_varint();
            break;
        case kFixed32:
            in.get_u32();
            break;
        case kBlock:
            in.get_bytes(in.get_varint());
            break;
        default:
            in.set_failed();
        }
    }
}

template <class T>
void decode_value(ByteReader& in, T& v, const FieldLimits& limits, int depth) {
    if (depth > 16) return in.set_failed();
    if constexpr (std::is_enum_v<T>) {
        std::underlying_type_t<T> raw{};
        decode_value(in, raw, limits, depth);
        v = T(raw);
    } else if constexpr (std::is_same_v<T, bool>) {
        const u64 raw = in.get_varint();
        if (raw > 1) return in.set_failed();
        v = raw != 0;
    } else if constexpr (std::is_integral_v<T> && std::is_signed_v<T>) {
        const i64 raw = in.get_svarint();
        if (raw < limits.least_value || raw > limits.most_value || raw < std::numeric_limits<T>::min() ||
            raw > std::numeric_limits<T>::max())
            return in.set_failed();
        v = T(raw);
    } else if constexpr (std::is_integral_v<T>) {
        const u64 raw = in.get_varint();
        if (raw > std::numeric_limits<T>::max() || (limits.least_value > 0 && raw < u64(limits.least_value)) ||
            (limits.most_value >= 0 && limits.most_value != std::numeric_limits<i64>::max() &&
             raw > u64(limits.most_value)))
            return in.set_failed();
        v = T(raw);
    } else if constexpr (std::is_same_v<T, float>) {
        v = in.get_f32();
        if (!(v - v == 0.0f)) in.set_failed(); // NaN and infinities never come from our own side
    } else if constexpr (std::is_same_v<T, std::string>) {
        v = std::string(in.get_string(limits.most));
    } else {
        const u64 size = in.get_varint();
        if constexpr (std::is_same_v<T, Bytes>) {
            if (size > limits.most) return in.set_failed();
            ByteView view = in.get_bytes(size);
            v.assign(view.begin(), view.end());
        } else {
            ByteReader inner(in.get_bytes(size));
            if constexpr (IsVector<T>::value) {
                v.clear();
                while (!inner.failed() && inner.remaining() > 0 && !in.failed()) {
                    if (v.size() >= limits.most) return in.set_failed();
                    v.emplace_back();
                    FieldLimits element = limits;
                    if constexpr (std::is_same_v<typename T::value_type, std::string>) element.most = 65536;
                    decode_value(inner, v.back(), element, depth + 1);
                }
            } else {
                decode_struct(inner, v, depth + 1);
            }
            if (inner.failed()) in.set_failed();
        }
    }
}

} // namespace detail

template <detail::HasFields T>
Bytes encode_fields(const T& value) {
    ByteWriter out;
    detail::encode_struct(out, value);
    return out.take();
}

// Errors: damaged, where a byte is missing, a value out of its limits or a kind wrong.
template <detail::HasFields T>
Result<T> decode_fields(ByteView bytes) {
    ByteReader in(bytes);
    T value;
    detail::decode_struct(in, value, 0);
    if (!in.finished()) return fail(ErrorCode::damaged, "record does not parse");
    return value;
}

} // namespace vitrail
