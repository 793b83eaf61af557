// Expressions: every operation against doubles, precedence, noise by name, errors that point at their column, and no
// text that crashes.
#include "terrain/compile/expression.h"

#include "base/rng.h"
#include "terrain/compile/names.h"
#include "terrain/cpu/noise_rows.h"
#include "terrain/kernel/program_kernel.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>

using namespace vitrail;

namespace {

using L = ScalarLanes;

struct Fixture {
    std::unique_ptr<TerrainTables> t = std::make_unique<TerrainTables>();
    TableBuilder builder{*t};
    Fixture() {
        t->seed = 11;
        builder.inputs = {"wet", "cold"};
    }
    Spot<L> spot{160, -320, 3, 60, 5};
    float inputs[kInputs] = {0.25f, -2.5f};

    float value(std::string_view text) {
        const auto program = compile_expression(text, "test", builder);
        EXPECT_TRUE(program) << text << ": " << program.error().message;
        return program ? run_program<L>(*t, *program, spot, inputs) : std::nanf("");
    }
    std::string error(std::string_view text) {
        const auto program = compile_expression(text, "test", builder);
        EXPECT_FALSE(program) << text;
        return program ? "" : program.error().message;
    }
    // Of the ordinal-th noise of a text.
    const NoiseOctave* octaves(NoiseKind kind, double frequency, u32 count, u64 ordinal) {
        return &t->octave[t->noise[builder.add_noise(kind, frequency, count, purpose_of("test", ordinal)).value()]
                              .first];
    }
};

double step(double a, double b, double x) {
    const double t = std::min(std::max((x - a) / (b - a), 0.0), 1.0);
    return t * t * (3 - 2 * t);
}

} // namespace

TEST(Expression, OperatorsHaveTheirUsualPrecedence) {
    Fixture f;
    EXPECT_EQ(f.value("1 + 2*3 - 4/8"), 6.5f);
    EXPECT_EQ(f.value("2 - 3 - 4"), -5.0f);
    EXPECT_EQ(f.value("16/4/2"), 2.0f);
    EXPECT_EQ(f.value("-2^2"), -4.0f);
    EXPECT_EQ(f.value("2^-1"), 0.5f);
    EXPECT_EQ(f.value("(1 + 2)*3"), 9.0f);
    EXPECT_EQ(f.value("--3"), 3.0f);
    EXPECT_EQ(f.value("2 wet"), 0.5f);
    EXPECT_EQ(f.value("2(wet + 1)wet"), 0.625f);
    EXPECT_EQ(f.value(".0065*1000"), float(.0065) * 1000.0f);
    EXPECT_EQ(f.value("\t1 +\n 1"), 2.0f);
    EXPECT_EQ(f.value("-cold"), 2.5f);
    EXPECT_EQ(f.value("cold^2"), 6.25f);
    EXPECT_EQ(f.value("cold^3"), -15.625f);
    EXPECT_EQ(f.value("cold^4"), 39.0625f);
    EXPECT_EQ(f.value("cold^1"), -2.5f);
}

// Folded constants and computed values must be the same, and near what doubles say.
TEST(Expression, OperationsEqualDoubles) {
    Fixture f;
    Rng rng(3);
    const auto number = [&] { return float(i32(rng.below(4001)) - 2000) / 100; };
    const auto text_of = [](float v) { return v < 0 ? "(-" + std::to_string(-v) + ")" : std::to_string(v); };
    f.builder.inputs = {"a", "b", "c"};
    struct Row {
        const char* text;
        double (*value)(double, double, double);
        double error;
    };
    const Row rows[] = {
        {"a + b", [](double a, double b, double) { return a + b; }, 1e-5},
        {"a - b", [](double a, double b, double) { return a - b; }, 1e-5},
        {"a * b", [](double a, double b, double) { return a * b; }, 1e-4},
        {"a / b", [](double a, double b, double) { return b == 0 ? 0 : a / b; }, 1e-6},
        {"min(a, b)", [](double a, double b, double) { return std::min(a, b); }, 1e-6},
        {"max(a, b, c)",
         [](double a, double b, double c) {
             return std::max({a, b, c});
         },
         1e-6},
        {"abs(a)", [](double a, double, double) { return std::abs(a); }, 1e-6},
        {"sqrt(a)", [](double a, double, double) { return std::sqrt(std::max(a, 0.0)); }, 1e-5},
        {"pow(a, b/4)", [](double a, double b, double) { return a <= 0 ? 0 : std::pow(a, b / 4); }, 1e-3},
        {"abs(a)^1.7", [](double a, double, double) { return std::pow(std::abs(a), 1.7); }, 1e-3},
        {"ss(a, b, c)", [](double a, double b, double c) { return a == b ? double(c >= a) : step(a, b, c); }, 1e-4},
        {"ss(.35, .25, a/20)", [](double a, double, double) { return step(.35, .25, a / 20); }, 1e-4},
    };
    for (const Row& row : rows) {
        for (int i = 0; i < 60; ++i) {
            const float a = number(), b = i % 20 == 0 ? 0.0f : number(), c = number();
            f.inputs[0] = a, f.inputs[1] = b, f.inputs[2] = c;
            const double wanted = row.value(double(a), double(b), double(c));
            const float got = f.value(row.text);
            EXPECT_NEAR(got, wanted, row.error * (1 + std::abs(wanted)))
                << row.text << ' ' << a << ' ' << b << ' ' << c;
            std::string folded;
            for (const char* p = row.text; *p; ++p) {
                const bool name = *p >= 'a' && *p <= 'c' && (p == row.text || p[-1] < 'a' || p[-1] > 'z') &&
                                  (p[1] < 'a' || p[1] > 'z');
                folded += name ? text_of(*p == 'a' ? a : *p == 'b' ? b : c) : std::string(1, *p);
            }
            f.builder.inputs.clear();
            EXPECT_NEAR(f.value(folded), got, 1e-5 * (1 + std::abs(double(got)))) << folded;
            f.builder.inputs = {"a", "b", "c"};
        }
    }
    EXPECT_EQ(f.value("1/0"), 0.0f);
}

TEST(Expression, NoiseFollowsFromOwnerAndOrder) {
    Fixture f;
    EXPECT_EQ(f.value("107 + 16F(.0065)"),
              107.0f + fractal2<L>(f.octaves(NoiseKind::simplex2, .0065, 5, 0), 5, f.spot) * 16.0f);
    EXPECT_EQ(f.value("0 F(.1) + F3(.02)"), fractal2<L>(f.octaves(NoiseKind::simplex2, .02, 3, 1), 3, f.spot));
    EXPECT_EQ(f.value("S(.02)"), simplex2<L>(*f.octaves(NoiseKind::simplex2, .02, 1, 0), f.spot));
    EXPECT_EQ(f.value("G(.02)"), fractal3<L>(f.octaves(NoiseKind::simplex3, .02, 5, 0), 5, f.spot));
    EXPECT_EQ(f.value("G2(.02)"), fractal3<L>(f.octaves(NoiseKind::simplex3, .02, 2, 0), 2, f.spot));
    EXPECT_NE(f.value("F(.01) - F(.01)"), 0.0f);
    EXPECT_EQ(f.value("n = F(.01); n - n"), 0.0f);
    EXPECT_EQ(f.value("F(.01)"), f.value("F(.01)"));
    const auto other = compile_expression("F(.01)", "other", f.builder);
    ASSERT_TRUE(other);
    EXPECT_NE(run_program<L>(*f.t, *other, f.spot, nullptr), f.value("F(.01)"));

    const auto cells = worley2<L>(*f.octaves(NoiseKind::cellular, .03, 1, 0), f.spot);
    EXPECT_EQ(f.value("W(.03)"), cells.f1);
    EXPECT_EQ(f.value("E(.03)"), (cells.f2 - cells.f1) * 0.5f);
    EXPECT_EQ(f.value("R(.03)"), unit_of(cells.cell));
    EXPECT_EQ(f.value("W(.03) - W(.03) + R(.03)"), unit_of(cells.cell)); // the same points
    EXPECT_NE(f.value("W(.03) - W(.031)"), 0.0f);
}

TEST(Expression, WarpMovesThePlaceOfItsValueAlone) {
    Fixture f;
    Spot<L> moved = f.spot;
    moved.dx += 7;
    moved.dz += -2.5f;
    EXPECT_EQ(f.value("warp(7, cold, S(.02)) + 100 S(.03)"),
              simplex2<L>(*f.octaves(NoiseKind::simplex2, .02, 1, 0), moved) +
                  simplex2<L>(*f.octaves(NoiseKind::simplex2, .03, 1, 1), f.spot) * 100.0f);
    EXPECT_NE(f.error("warp(1, 2, warp(1, 2, 3))").find("column 12"), std::string::npos);
    EXPECT_EQ(f.value("warp(warp(1, 2, 3), 0, 4)"), 4.0f);
    // Whatever a warp says, the noise stays in its range.
    EXPECT_LE(std::abs(f.value("warp(1000000*1000000*wet, sqrt(1000000^4), F(.5))")), 1.0f);
}

TEST(Expression, NamedValuesAreComputedOnce) {
    Fixture f;
    EXPECT_EQ(f.value("x = 3 wet; y = x + 1; x*y + x"), 0.75f * 1.75f + 0.75f);
    EXPECT_EQ(f.value("x = wet; x"), 0.25f);
    const auto program = compile_expression("n = F(.0035); abs(n) + n^2 + n", "test", f.builder);
    ASSERT_TRUE(program);
    int noises = 0;
    for (u32 i = 0; i < program->count; ++i)
        noises += f.t->instruction[program->first + i].op == Op::fractal2;
    EXPECT_EQ(noises, 1);
    EXPECT_NE(f.error("x = 1; x = 2; x").find("has a meaning"), std::string::npos);
    EXPECT_NE(f.error("F = 1; 2").find("has a meaning"), std::string::npos);
    EXPECT_NE(f.error("wet = 1; 2").find("has a meaning"), std::string::npos);
    f.error("x = x; x");
    f.error("x = 1");
    f.error("x = 1;");
}

TEST(Expression, TheHeightsOfTheBaseGameCompile) {
    Fixture f;
    for (const char* text :
         {"107+24F(.006)+22 ss(1,0,((F4(.0055)+1)/2)^2.4)",
          "136+9F4(.008) + 14 ss(.3,.2,W(.007)) + 9 ss(.3,.2,W(.0045))",
          "e = warp(20F3(.015), 20F3(.015), E(.003)); 122+10 ss(0,.05,e)+(37.5+5F4(.03)) ss(.07,.22,e)+6S(.025)",
          "128+16S(.015)+9F3(.007)+(1.2 ss(.45,.35,W(.015))+.6 ss(.45,.35,W(.021)))(54+7F3(.02))",
          "n = (abs(F(.0035))+.05)^2 + .1(F(.005)-.5); 165+140(n-.15)+20n F(.035)"}) {
        const float v = f.value(text);
        EXPECT_GT(v, 50) << text;
        EXPECT_LT(v, 400) << text;
    }
}

TEST(Expression, ErrorsNameTheOwnerAndTheColumn) {
    Fixture f;
    const std::pair<const char*, const char*> rows[] = {
        {"", "test: column 1: expected a number, a name or '(', found the end"},
        {"2 3", "test: column 3: expected an operator or the end, found '3'"},
        {"F(x)", "test: column 3: expected a frequency (a plain number), found 'x'"},
        {"1 + foo", "test: column 5: 'foo' is no function, value or input; inputs are: wet, cold"},
        {"(1 + 2", "test: column 7: expected ')', found the end"},
        {"ss(1, 2)", "test: column 8: ss takes 3 values, found 2"},
        {"abs(1, 2)", "test: column 6: abs takes 1 values"},
        {"1 $ 2", "test: column 3: '$' means nothing here"},
        {"1.2.3", "test: column 1: expected a number up to 1000000, found '1.2.3'"},
        {"F(0)", "test: column 3: expected a frequency above 0"},
    };
    for (const auto& [text, message] : rows)
        EXPECT_EQ(f.error(text), message);
    EXPECT_NE(f.error("F(.6)").find("column 1: frequency 0.6"), std::string::npos);
    for (const char* text : {"+1",      "1 +",
                             "*",       "min(1)",
                             "pow(1)",  "F()",
                             "F",       "F9(.1)",
                             "1e5",     ".",
                             "1..2",    "9999999",
                             "abs 1",   "x = ;",
                             "a;",      "\xc3\xa9",
                             "1 == 2",  "((((((",
                             "))",      ",",
                             "2000000", "1000000^4*1000000^4"})
        f.error(text);
}

TEST(Expression, LongDeepAndWideTextsEndInAnError) {
    Fixture f;
    EXPECT_NE(f.error(std::string(5000, '1')).find("longer"), std::string::npos);
    EXPECT_NE(f.error(std::string(900, '(')).find("nested"), std::string::npos);
    EXPECT_NE(f.error(std::string(900, '-') + "1").find("nested"), std::string::npos);
    std::string powers = "2";
    for (int i = 0; i < 400; ++i)
        powers += "^2";
    EXPECT_NE(f.error(powers).find("nested"), std::string::npos);
    std::string many = "wet"; // a long sum needs two registers
    for (int i = 0; i < 300; ++i)
        many += "+wet";
    EXPECT_EQ(f.value(many), 0.25f * 301);
    std::string right = "wet"; // and so does one that leans to the other side
    for (int i = 0; i < 40; ++i)
        right = "wet+(" + right + ")";
    EXPECT_EQ(f.value(right), 0.25f * 41);
    std::string values, sum = "0";
    for (char c = 'a'; c <= 'n'; ++c) {
        values += std::string(1, c) + "= wet + cold;";
        sum += std::string("+") + c;
    }
    EXPECT_NE(f.error(values + sum).find("numbers at once"), std::string::npos);
}

TEST(Expression, FractalTextsOfVeins) {
    EXPECT_EQ(parse_fractal("F3(.05)", "vein")->octaves, 3u);
    EXPECT_EQ(parse_fractal("F3(.05)", "vein")->frequency, .05);
    EXPECT_EQ(parse_fractal("S(.2)", "vein")->octaves, 1u);
    for (const char* text : {"", "F", "F(", "F(.1", "F(.1))", "W(.1)", "3", "F(0)", "F(x)", "F(.1)+1"})
        EXPECT_FALSE(parse_fractal(text, "vein")) << text;
}

namespace {

// A random expression of a given depth.
std::string random_text(Rng& rng, u32 depth) {
    const auto inner = [&] { return random_text(rng, depth - 1); };
    if (depth == 0) {
        switch (rng.below(6)) {
        case 0:
            return "F" + std::to_string(1 + rng.below(4)) + "(.0" + std::to_string(1 + rng.below(40)) + ")";
        case 1:
            return "W(.0" + std::to_string(1 + rng.below(40)) + ")";
        case 2:
            return "R(.02)";
        case 3:
            return "wet";
        default:
            return std::to_string(rng.below(40)) + "." + std::to_string(rng.below(100));
        }
    }
    switch (rng.below(12)) {
    case 0:
        return inner() + "+" + inner();
    case 1:
        return inner() + "-" + inner();
    case 2:
        return "(" + inner() + ")*(" + inner() + ")";
    case 3:
        return "(" + inner() + ")/(" + inner() + ")";
    case 4:
        return "-(" + inner() + ")";
    case 5:
        return "min(" + inner() + "," + inner() + ")";
    case 6:
        return "max(" + inner() + "," + inner() + ",2)";
    case 7:
        return "abs(" + inner() + ")";
    case 8:
        return "sqrt(" + inner() + ")";
    case 9:
        return "(" + inner() + ")^" + std::to_string(2 + rng.below(3));
    case 10:
        return "pow(" + inner() + ",1.3)";
    default:
        return "ss(" + inner() + ",9," + inner() + ")";
    }
}

u32 bits_of(float v) {
    u32 b;
    std::memcpy(&b, &v, sizeof b);
    return b;
}

} // namespace

TEST(Expression, MutatedTextsNeverCrash) {
    const char* seeds[] = {"n = abs(F(.0035)) + .05; 165 + 140(n^2 - .15) + 20 n F(.035)",
                           "warp(20F3(.015), 20 F3(.015), ss(.07,.22,E(.003)) + W(.01)*R(.01)) / (1 - wet)",
                           "107+24F(.006)+22 ss(1,0,((F4(.0055)+1)/2)^2.4)"};
    Rng rng(8);
    int good = 0, bad = 0;
    auto fixture = std::make_unique<Fixture>();
    for (int i = 0; i < 6000; ++i) {
        if (i % 50 == 0) fixture = std::make_unique<Fixture>(); // else its tables fill up
        Fixture& f = *fixture;
        std::string text = seeds[rng.below(3)];
        for (u32 k = 0, n = 1 + rng.below(4); k < n && !text.empty(); ++k) {
            const std::size_t at = rng.below(u32(text.size()));
            constexpr std::string_view kPieces[] = {"(", ")", "F", ",",     ";",    "=", "-",    "^",    "1",
                                                    ".", "*", " ", "W(.1)", "min(", "n", "\x80", "warp("};
            switch (rng.below(4)) {
            case 0:
                text.erase(at, 1 + rng.below(4));
                break;
            case 1:
                text[at] = char(rng.below(256));
                break;
            default:
                text.insert(at, kPieces[rng.below(u32(std::size(kPieces)))]);
            }
        }
        const auto program = compile_expression(text, "test", f.builder);
        if (program) {
            ++good;
            (void)run_program<L>(*f.t, *program, f.spot, f.inputs);
            for (u32 k = program->first; k < u32(program->first) + program->count; ++k) {
                const Instruction& in = f.t->instruction[k];
                ASSERT_LT(in.to, kProgramRegisters);
                ASSERT_LT(in.a, kProgramRegisters);
                ASSERT_LT(in.b, kProgramRegisters);
                ASSERT_LT(in.c, kProgramRegisters);
            }
        } else {
            ++bad;
            EXPECT_FALSE(program.error().message.empty());
        }
    }
    EXPECT_GT(good, 200);
    EXPECT_GT(bad, 2000);
}

TEST(Expression, ProgramsGiveTheSameBitsOnEveryVectorSet) {
    Rng rng(2);
    auto fixture = std::make_unique<Fixture>();
    std::vector<float> out(256);
    for (int i = 0; i < 120; ++i) {
        if (i % 20 == 0) fixture = std::make_unique<Fixture>();
        Fixture& f = *fixture;
        const std::string text = random_text(rng, 1 + rng.below(4));
        const auto program = compile_expression(text, "test", f.builder);
        ASSERT_TRUE(program) << text << ": " << program.error().message;
        const ColumnPos at{i % 3 == 0 ? (1 << 27) - 32 : i32(rng.below(100000)) - 50000,
                           i % 5 == 0 ? -(1 << 27) + 32 : i};
        for (const Isa isa : {Isa::portable, Isa::avx2, Isa::avx512}) {
            if (isa > best_isa()) continue;
            noise_rows(isa).program(*f.t, *program, at, 60, f.inputs, out.data());
            for (int k = 0; k < 256; ++k) {
                const Spot<L> spot{i32(u32(at.x) << 4), i32(u32(at.z) << 4), float(k & 15), 60, float(k >> 4)};
                const float wanted = run_program<L>(*f.t, *program, spot, f.inputs), got = out[std::size_t(k)];
                if (std::isnan(wanted) && std::isnan(got)) continue; // which NaN it is, nobody asks
                ASSERT_EQ(bits_of(got), bits_of(wanted)) << text << " isa " << int(isa);
            }
        }
    }
}
