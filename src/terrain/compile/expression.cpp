#include "terrain/compile/expression.h"

#include "terrain/compile/expression_code.h"
#include "terrain/compile/names.h"

#include <charconv>
#include <fmt/format.h>

namespace vitrail {

namespace {

using expression::Call;
using expression::Node;
using expression::Tree;

constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
constexpr bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

enum class Token : u8 { number, name, sign, end };

struct Function {
    std::string_view name;
    Call call;
    u32 least, most; // arguments
};
constexpr Function kFunctions[] = {
    {"ss", Call::smoothstep, 3, 3}, {"abs", Call::absolute, 1, 1},  {"sqrt", Call::square_root, 1, 1},
    {"min", Call::least, 2, 16},    {"max", Call::greatest, 2, 16}, {"pow", Call::power, 2, 2},
    {"warp", Call::warp, 3, 3},
};

// Noise by its letter: F, F4, G, G3, S, W, E, R; octaves 0: none of these.
struct NoiseName {
    NoiseKind kind = NoiseKind::simplex2;
    Op op = Op::fractal2;
    u32 octaves = 0;
};
NoiseName noise_name(std::string_view name) {
    const char letter = name[0];
    if (name.size() == 1) {
        switch (letter) {
        case 'F':
            return {NoiseKind::simplex2, Op::fractal2, 5};
        case 'G':
            return {NoiseKind::simplex3, Op::fractal3, 5};
        case 'S':
            return {NoiseKind::simplex2, Op::fractal2, 1};
        case 'W':
            return {NoiseKind::cellular, Op::cell_distance, 1};
        case 'E':
            return {NoiseKind::cellular, Op::cell_edge, 1};
        case 'R':
            return {NoiseKind::cellular, Op::cell_random, 1};
        default:
            return {};
        }
    }
    if (name.size() != 2 || name[1] < '1' || name[1] > '8') return {};
    if (letter == 'F') return {NoiseKind::simplex2, Op::fractal2, u32(name[1] - '0')};
    if (letter == 'G') return {NoiseKind::simplex3, Op::fractal3, u32(name[1] - '0')};
    return {};
}

class Parser {
public:
    Parser(std::string_view text, std::string_view owner, TableBuilder* builder)
        : text_(text)
        , owner_(owner)
        , builder_(builder) {}

    Result<Program> compile() {
        if (text_.size() > kExpressionLengthMost)
            return fail(ErrorCode::limit, fmt::format("{}: longer than {} characters", owner_, kExpressionLengthMost));
        VX_TRY(next());
        VX_TRY(definitions());
        VX_TRY_ASSIGN(const u16 root, sum(0));
        if (token_ != Token::end) return unexpected("an operator or the end");
        tree_.root = root;
        auto code = expression::generate(tree_);
        if (!code) return fail(code.error().code, fmt::format("{}: {}", owner_, code.error().message));
        auto program = builder_->add_program(*code);
        if (!program) return fail(program.error().code, fmt::format("{}: {}", owner_, program.error().message));
        return *program;
    }

    Result<FractalText> fractal() {
        VX_TRY(next());
        const NoiseName noise = token_ == Token::name ? noise_name(word_) : NoiseName{};
        if (noise.octaves == 0 || noise.kind == NoiseKind::cellular)
            return unexpected("F(frequency), F3(frequency) or S(frequency)");
        VX_TRY(next());
        VX_TRY(take('('));
        FractalText out{noise.octaves, number_};
        VX_TRY_ASSIGN(out.frequency, frequency());
        VX_TRY(take(')'));
        if (token_ != Token::end) return unexpected("the end");
        return out;
    }

private:
    tl::unexpected<Error> error(std::size_t at, std::string_view what) const {
        return fail(ErrorCode::invalid_argument, fmt::format("{}: column {}: {}", owner_, at + 1, what));
    }
    tl::unexpected<Error> unexpected(std::string_view wanted) const {
        if (token_ == Token::end) return error(start_, fmt::format("expected {}, found the end", wanted));
        return error(start_, fmt::format("expected {}, found '{}'", wanted,
                                         token_ == Token::sign ? std::string_view(&sign_, 1) : word_));
    }

    Result<> next() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n'))
            ++at_;
        start_ = at_;
        if (at_ >= text_.size()) {
            token_ = Token::end;
            return {};
        }
        const char c = text_[at_];
        if (is_digit(c) || c == '.') return next_number();
        if (is_letter(c)) {
            while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_])))
                ++at_;
            token_ = Token::name;
            word_ = text_.substr(start_, at_ - start_);
            return {};
        }
        if (std::string_view("+-*/^(),;=").find(c) == std::string_view::npos)
            return error(at_, u8(c) >= 32 && u8(c) < 127 ? fmt::format("'{}' means nothing here", c)
                                                         : "a character outside ASCII");
        token_ = Token::sign;
        sign_ = c;
        ++at_;
        return {};
    }

    Result<> next_number() {
        while (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.'))
            ++at_;
        word_ = text_.substr(start_, at_ - start_);
        double value = 0;
        const auto [end, code] =
            std::from_chars(word_.data(), word_.data() + word_.size(), value, std::chars_format::fixed);
        if (code != std::errc{} || end != word_.data() + word_.size() || !(value <= 1e6))
            return error(start_, fmt::format("expected a number up to 1000000, found '{}'", word_));
        token_ = Token::number;
        number_ = value;
        return {};
    }

    bool is(char sign) const { return token_ == Token::sign && sign_ == sign; }
    Result<> take(char sign) {
        if (!is(sign)) return unexpected(fmt::format("'{}'", sign));
        return next();
    }

    Result<u16> add(Node node) {
        if (tree_.nodes.size() >= expression::kNodesMost) return error(start_, "too many parts");
        return tree_.add(node);
    }

    // NAME = sum; ...
    Result<> definitions() {
        while (token_ == Token::name) {
            std::size_t after = at_;
            while (after < text_.size() && (text_[after] == ' ' || text_[after] == '\t' || text_[after] == '\n'))
                ++after;
            if (after >= text_.size() || text_[after] != '=') return {};
            const std::string_view name = word_;
            if (noise_name(name).octaves > 0 || find_function(name) || find_value(name) || find_input(name) >= 0)
                return error(start_, fmt::format("'{}' has a meaning already", name));
            VX_TRY(next());
            VX_TRY(take('='));
            VX_TRY_ASSIGN(const u16 value, sum(0));
            VX_TRY(take(';'));
            values_.push_back({name, u16(tree_.values.size())});
            tree_.values.push_back(value);
        }
        return {};
    }

    Result<u16> sum(u32 depth) {
        VX_TRY_ASSIGN(u16 left, product(depth));
        while (is('+') || is('-')) {
            const Call call = is('+') ? Call::add : Call::subtract;
            VX_TRY(next());
            VX_TRY_ASSIGN(const u16 right, product(depth));
            VX_TRY_ASSIGN(left, add({.call = call, .a = left, .b = right}));
        }
        return left;
    }

    Result<u16> product(u32 depth) {
        VX_TRY_ASSIGN(u16 left, unary(depth));
        for (;;) {
            Call call = Call::multiply;
            if (is('*') || is('/')) {
                if (is('/')) call = Call::divide;
                VX_TRY(next());
            } else if (token_ != Token::name && !is('(')) { // else a product without a sign
                return left;
            }
            VX_TRY_ASSIGN(const u16 right, unary(depth));
            VX_TRY_ASSIGN(left, add({.call = call, .a = left, .b = right}));
        }
    }

    Result<u16> unary(u32 depth) {
        if (depth >= kExpressionDepthMost)
            return fail(ErrorCode::limit, fmt::format("{}: column {}: more than {} nested parts", owner_, start_ + 1,
                                                      kExpressionDepthMost));
        if (is('-')) {
            VX_TRY(next());
            VX_TRY_ASSIGN(const u16 a, unary(depth + 1));
            return add({.call = Call::negate, .a = a});
        }
        VX_TRY_ASSIGN(const u16 base, primary(depth));
        if (!is('^')) return base;
        VX_TRY(next());
        VX_TRY_ASSIGN(const u16 exponent, unary(depth + 1));
        if (tree_.nodes.size() + 2 > expression::kNodesMost) return error(start_, "too many parts");
        return tree_.add_power(base, exponent);
    }

    Result<u16> primary(u32 depth) {
        if (token_ == Token::number) {
            const float k = float(number_);
            VX_TRY(next());
            return add({.call = Call::constant, .k = k});
        }
        if (is('(')) {
            VX_TRY(next());
            VX_TRY_ASSIGN(const u16 inner, sum(depth + 1));
            VX_TRY(take(')'));
            return inner;
        }
        if (token_ != Token::name) return unexpected("a number, a name or '('");
        const std::string_view name = word_;
        const std::size_t at = start_;
        if (const Value* value = find_value(name)) {
            VX_TRY(next());
            return add({.call = Call::value, .index = value->index});
        }
        if (const int input = find_input(name); input >= 0) {
            VX_TRY(next());
            return add({.call = Call::input, .index = u16(input)});
        }
        if (const NoiseName noise = noise_name(name); noise.octaves > 0) {
            VX_TRY(next());
            return noise_call(noise, at);
        }
        if (const Function* function = find_function(name)) {
            VX_TRY(next());
            return function_call(*function, at, depth);
        }
        return error(at, fmt::format("'{}' is no function, value or input; inputs are: {}", name, input_names()));
    }

    Result<double> frequency() {
        const std::size_t at = start_;
        if (token_ != Token::number) return unexpected("a frequency (a plain number)");
        const double value = number_;
        VX_TRY(next());
        if (!(value > 0)) return error(at, "expected a frequency above 0");
        return value;
    }

    Result<u16> noise_call(NoiseName noise, std::size_t at) {
        VX_TRY(take('('));
        VX_TRY_ASSIGN(const double s, frequency());
        VX_TRY(take(')'));
        const u32 ordinal = calls_++;
        for (const Cells& known : cells_)
            if (noise.kind == NoiseKind::cellular && known.frequency == s)
                return add({.call = Call::noise, .op = noise.op, .index = known.noise});
        const auto index = builder_->add_noise(noise.kind, s, noise.octaves, purpose_of(owner_, ordinal));
        if (!index)
            return fail(index.error().code, fmt::format("{}: column {}: {}", owner_, at + 1, index.error().message));
        if (noise.kind == NoiseKind::cellular) cells_.push_back({s, *index});
        return add({.call = Call::noise, .op = noise.op, .index = *index});
    }

    Result<u16> function_call(const Function& function, std::size_t at, u32 depth) {
        if (function.call == Call::warp) {
            if (warped_) return error(at, "a warp within a warp");
        }
        VX_TRY(take('('));
        u16 arguments[16] = {};
        u32 count = 0;
        for (;;) {
            const bool inner = function.call == Call::warp && count == 2;
            if (inner) warped_ = true;
            VX_TRY_ASSIGN(const u16 argument, sum(depth + 1));
            if (inner) warped_ = false;
            arguments[count++] = argument;
            if (!is(',')) break;
            if (count == function.most)
                return error(start_, fmt::format("{} takes {} values", function.name, function.most));
            VX_TRY(next());
        }
        if (count < function.least)
            return error(start_, fmt::format("{} takes {} values, found {}", function.name, function.least, count));
        VX_TRY(take(')'));
        Node node{.call = function.call, .a = arguments[0], .b = arguments[1], .c = arguments[2]};
        if (count <= 3 && function.most <= 3) return add(node);
        VX_TRY_ASSIGN(u16 left, add({.call = function.call, .a = arguments[0], .b = arguments[1]}));
        for (u32 i = 2; i < count; ++i) {
            VX_TRY_ASSIGN(left, add({.call = function.call, .a = left, .b = arguments[i]}));
        }
        return left;
    }

    struct Value {
        std::string_view name;
        u16 index;
    };
    struct Cells {
        double frequency;
        u16 noise;
    };

    static const Function* find_function(std::string_view name) {
        for (const Function& f : kFunctions)
            if (f.name == name) return &f;
        return nullptr;
    }
    const Value* find_value(std::string_view name) const {
        for (const Value& v : values_)
            if (v.name == name) return &v;
        return nullptr;
    }
    int find_input(std::string_view name) const {
        for (std::size_t i = 0; builder_ && i < builder_->inputs.size(); ++i)
            if (builder_->inputs[i] == name) return int(i);
        return -1;
    }
    std::string input_names() const {
        std::string all;
        for (const std::string& name : builder_->inputs)
            if (!name.empty()) all += (all.empty() ? "" : ", ") + name;
        return all.empty() ? "none" : all;
    }

    std::string_view text_, owner_;
    TableBuilder* builder_;
    Tree tree_;
    std::vector<Value> values_;
    std::vector<Cells> cells_;
    u32 calls_ = 0;
    bool warped_ = false;

    std::size_t at_ = 0, start_ = 0; // of the next character, of the token
    Token token_ = Token::end;
    std::string_view word_;
    char sign_ = 0;
    double number_ = 0;
};

} // namespace

Result<Program> compile_expression(std::string_view text, std::string_view owner, TableBuilder& builder) {
    return Parser(text, owner, &builder).compile();
}

Result<FractalText> parse_fractal(std::string_view text, std::string_view owner) {
    return Parser(text, owner, nullptr).fractal();
}

} // namespace vitrail
