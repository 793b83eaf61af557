#include "lua/pattern.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace vitrail::lua {

namespace {

constexpr std::size_t kNone = std::size_t(-1);
constexpr int kDepthMost = 200; // of recursion: captures, optional items and repeats

class Matcher {
public:
    Matcher(std::string_view subject, std::string_view pattern, u64 steps_most, PatternMatch& out)
        : s_(subject)
        , p_(pattern)
        , steps_most_(steps_most)
        , out_(out) {}

    // The end of a match of pattern[p..] at subject[s..], or kNone.
    std::size_t match(std::size_t s, std::size_t p) {
        if (depth_ == kDepthMost) return broken("pattern too complex");
        ++depth_;
        const std::size_t end = match_items(s, p);
        --depth_;
        return end;
    }
    bool stopped() const { return out_.error || out_.out_of_steps; }

private:
    std::size_t broken(const char* why) {
        if (!out_.error) out_.error = why;
        return kNone;
    }
    bool step() {
        if (out_.steps >= steps_most_)
            out_.out_of_steps = true;
        else
            ++out_.steps;
        return !out_.out_of_steps;
    }

    std::size_t match_items(std::size_t s, std::size_t p) {
        while (p < p_.size()) {
            if (!step() || out_.error) return kNone;
            const char c = p_[p];
            if (c == '(') {
                const bool position = p + 1 < p_.size() && p_[p + 1] == ')';
                return open_capture(s, p + (position ? 2 : 1), position ? kCapturePosition : kCaptureOpen);
            }
            if (c == ')') return close_capture(s, p + 1);
            if (c == '$' && p + 1 == p_.size()) return s == s_.size() ? s : kNone;
            if (c == '%' && p + 1 < p_.size()) {
                const char kind = p_[p + 1];
                if (kind == 'b') {
                    s = balanced(s, p + 2);
                    if (s == kNone) return kNone;
                    p += 4;
                    continue;
                }
                if (kind == 'f') {
                    p += 2;
                    if (p >= p_.size() || p_[p] != '[') return broken("missing '[' after '%f' in pattern");
                    const std::size_t end = class_end(p);
                    if (end == kNone) return kNone;
                    const char before = s == 0 ? '\0' : s_[s - 1], here = s < s_.size() ? s_[s] : '\0';
                    if (in_set(before, p, end) || !in_set(here, p, end)) return kNone;
                    p = end;
                    continue;
                }
                if (kind >= '0' && kind <= '9') {
                    s = same_again(s, kind);
                    if (s == kNone) return kNone;
                    p += 2;
                    continue;
                }
            }
            const std::size_t end = class_end(p);
            if (end == kNone) return kNone;
            const char repeat = end < p_.size() ? p_[end] : '\0';
            if (repeat == '*') return longest_first(s, p, end, 0);
            if (repeat == '+') return longest_first(s, p, end, 1);
            if (repeat == '-') return shortest_first(s, p, end);
            const bool fits = single(s, p, end);
            if (repeat == '?') {
                if (fits) {
                    const std::size_t with = match(s + 1, end + 1);
                    if (with != kNone || stopped()) return with;
                }
                p = end + 1;
                continue;
            }
            if (!fits) return kNone;
            ++s;
            p = end;
        }
        return s;
    }

    std::size_t longest_first(std::size_t s, std::size_t p, std::size_t end, std::size_t least) {
        std::size_t n = 0;
        while (single(s + n, p, end)) {
            if (!step()) return kNone;
            ++n;
        }
        for (;; --n) {
            if (n < least) return kNone;
            const std::size_t found = match(s + n, end + 1);
            if (found != kNone || stopped() || n == 0) return found;
        }
    }

    std::size_t shortest_first(std::size_t s, std::size_t p, std::size_t end) {
        for (;; ++s) {
            const std::size_t found = match(s, end + 1);
            if (found != kNone || stopped() || !single(s, p, end)) return found;
        }
    }

    std::size_t open_capture(std::size_t s, std::size_t p, std::ptrdiff_t size) {
        if (out_.captures >= kPatternCapturesMost) return broken("too many captures");
        out_.capture[out_.captures++] = {s, size};
        const std::size_t found = match(s, p);
        if (found == kNone) --out_.captures;
        return found;
    }

    std::size_t close_capture(std::size_t s, std::size_t p) {
        int open = out_.captures - 1;
        while (open >= 0 && out_.capture[open].size != kCaptureOpen)
            --open;
        if (open < 0) return broken("invalid pattern capture");
        out_.capture[open].size = std::ptrdiff_t(s - out_.capture[open].start);
        const std::size_t found = match(s, p);
        if (found == kNone) out_.capture[open].size = kCaptureOpen;
        return found;
    }

    std::size_t balanced(std::size_t s, std::size_t p) {
        if (p + 1 >= p_.size()) return broken("missing arguments to '%b'");
        if (s >= s_.size() || s_[s] != p_[p]) return kNone;
        int open = 1;
        while (++s < s_.size()) {
            if (!step()) return kNone;
            if (s_[s] == p_[p + 1]) {
                if (--open == 0) return s + 1;
            } else if (s_[s] == p_[p])
                ++open;
        }
        return kNone;
    }

    std::size_t same_again(std::size_t s, char digit) {
        const int i = digit - '1';
        if (i < 0 || i >= out_.captures || out_.capture[i].size == kCaptureOpen)
            return broken("invalid capture index in pattern");
        const PatternCapture& c = out_.capture[i];
        if (c.size == kCapturePosition) return kNone;
        const std::size_t size = std::size_t(c.size);
        for (std::size_t done = 0; done < size; done += 16) // longer texts cost more
            if (!step()) return kNone;
        return s_.substr(s, size) == s_.substr(c.start, size) ? s + size : kNone;
    }

    // One past the single-character class that starts at p.
    std::size_t class_end(std::size_t p) {
        const char c = p_[p++];
        if (c == '%') {
            if (p >= p_.size()) return broken("malformed pattern (ends with '%')");
            return p + 1;
        }
        if (c != '[') return p;
        if (p < p_.size() && p_[p] == '^') ++p;
        for (bool first = true; first || p >= p_.size() || p_[p] != ']'; first = false) {
            if (p >= p_.size()) return broken("malformed pattern (missing ']')");
            if (p_[p++] == '%') {
                if (p >= p_.size()) return broken("malformed pattern (missing ']')");
                ++p;
            }
        }
        return p + 1;
    }

    bool single(std::size_t s, std::size_t p, std::size_t end) const {
        if (s >= s_.size()) return false;
        switch (p_[p]) {
        case '.':
            return true;
        case '%':
            return in_class(s_[s], p_[p + 1]);
        case '[':
            return in_set(s_[s], p, end);
        default:
            return s_[s] == p_[p];
        }
    }

    // p at '[', end one past ']'.
    bool in_set(char c, std::size_t p, std::size_t end) const {
        ++p;
        const bool outside = p_[p] == '^';
        if (outside) ++p;
        const auto byte = [](char v) { return static_cast<unsigned char>(v); };
        for (const std::size_t last = end - 1; p < last;) {
            if (p_[p] == '%') {
                if (in_class(c, p_[p + 1])) return !outside;
                p += 2;
            } else if (p + 2 < last && p_[p + 1] == '-') {
                if (byte(p_[p]) <= byte(c) && byte(c) <= byte(p_[p + 2])) return !outside;
                p += 3;
            } else if (p_[p++] == c)
                return !outside;
        }
        return outside;
    }

    static bool in_class(char c, char kind) {
        const int v = static_cast<unsigned char>(c);
        bool in = false;
        switch (std::tolower(static_cast<unsigned char>(kind))) {
        case 'a':
            in = std::isalpha(v);
            break;
        case 'c':
            in = std::iscntrl(v);
            break;
        case 'd':
            in = std::isdigit(v);
            break;
        case 'g':
            in = std::isgraph(v);
            break;
        case 'l':
            in = std::islower(v);
            break;
        case 'p':
            in = std::ispunct(v);
            break;
        case 's':
            in = std::isspace(v);
            break;
        case 'u':
            in = std::isupper(v);
            break;
        case 'w':
            in = std::isalnum(v);
            break;
        case 'x':
            in = std::isxdigit(v);
            break;
        default:
            return kind == c;
        }
        return std::isupper(static_cast<unsigned char>(kind)) ? !in : in;
    }

    std::string_view s_, p_;
    u64 steps_most_;
    PatternMatch& out_;
    int depth_ = 0;
};

} // namespace

PatternMatch match_pattern(std::string_view subject, std::string_view pattern, std::size_t start, bool anchored,
                           u64 steps_most) {
    PatternMatch out;
    Matcher matcher(subject, pattern, steps_most, out);
    for (std::size_t s = start; s <= subject.size(); ++s) {
        out.captures = 0;
        const std::size_t end = matcher.match(s, 0);
        if (matcher.stopped()) break;
        if (end != kNone) {
            out.matched = true;
            out.begin = s;
            out.end = end;
            break;
        }
        if (anchored) break;
        if (++out.steps > steps_most) { // an empty attempt costs too
            out.out_of_steps = true;
            break;
        }
    }
    return out;
}

} // namespace vitrail::lua
