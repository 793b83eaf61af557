#include "script/block_variants.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace vitrail {

Result<std::vector<std::pair<std::string, std::string>>> parse_conditions(const std::string& key,
                                                                          const std::vector<PropertyDef>& properties) {
    std::vector<std::pair<std::string, std::string>> out;
    for (std::size_t at = 0; at <= key.size();) {
        const std::size_t end = std::min(key.find(',', at), key.size());
        const std::string word = key.substr(at, end - at);
        at = end + 1;
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos)
            return fail(ErrorCode::invalid_argument,
                        fmt::format("variant \"{}\": expected property=value[,property=value...]", key));
        const std::string name = word.substr(0, equals), value = word.substr(equals + 1);
        const auto property =
            std::find_if(properties.begin(), properties.end(), [&](const PropertyDef& p) { return p.name == name; });
        if (property == properties.end())
            return fail(ErrorCode::invalid_argument, fmt::format("variant \"{}\": there is no property {}", key, name));
        if (std::find(property->values.begin(), property->values.end(), value) == property->values.end())
            return fail(ErrorCode::invalid_argument, fmt::format("variant \"{}\": {} is one of {}, not \"{}\"", key,
                                                                 name, fmt::join(property->values, ", "), value));
        if (std::any_of(out.begin(), out.end(), [&](const auto& c) { return c.first == name; }))
            return fail(ErrorCode::invalid_argument, fmt::format("variant \"{}\": {} is there twice", key, name));
        out.emplace_back(name, value);
    }
    std::sort(out.begin(), out.end());
    return out;
}

Result<std::vector<BlockVariant>>
resolve_variants(const std::vector<PropertyDef>& properties, std::vector<WrittenVariant> written,
                 const std::function<Result<BlockLook>(const std::vector<const WrittenVariant*>&)>& look_with) {
    // Order of application; equal counts by key, so that no order of a Lua table matters.
    std::sort(written.begin(), written.end(), [](const WrittenVariant& a, const WrittenVariant& b) {
        return std::pair(a.when.size(), a.when) < std::pair(b.when.size(), b.when);
    });

    // Only the properties that some variant names matter; every combination of their values has a set of variants that
    // match it.
    std::vector<const PropertyDef*> used;
    for (const PropertyDef& p : properties)
        if (std::any_of(written.begin(), written.end(), [&](const WrittenVariant& v) {
                return std::any_of(v.when.begin(), v.when.end(), [&](const auto& c) { return c.first == p.name; });
            }))
            used.push_back(&p);
    struct Condition {
        std::size_t property, value;
    };
    std::vector<std::vector<Condition>> conditions;
    for (const WrittenVariant& v : written) {
        auto& list = conditions.emplace_back();
        for (const auto& [name, value] : v.when)
            for (std::size_t p = 0; p < used.size(); ++p)
                if (used[p]->name == name)
                    list.push_back({p, std::size_t(std::find(used[p]->values.begin(), used[p]->values.end(), value) -
                                                   used[p]->values.begin())});
    }

    // Which sets occur. The conditions of a set together match just the states that match it or more, and a set comes
    // after its subsets when sorted by size: so the last match is the full set of a state.
    std::map<std::pair<std::size_t, std::vector<u32>>, bool> sets;
    std::vector<std::size_t> place(used.size(), 0);
    for (bool more = !written.empty(); more;) {
        std::vector<u32> matching;
        for (u32 v = 0; v < written.size(); ++v)
            if (std::all_of(conditions[v].begin(), conditions[v].end(),
                            [&](const Condition& c) { return place[c.property] == c.value; }))
                matching.push_back(v);
        if (!matching.empty()) sets.emplace(std::pair(matching.size(), matching), true);
        std::size_t p = 0;
        while (p < used.size() && ++place[p] == used[p]->values.size())
            place[p++] = 0;
        more = p < used.size();
    }

    std::vector<BlockVariant> out;
    for (const auto& [set, unused] : sets) {
        std::vector<const WrittenVariant*> layers;
        std::map<std::string, std::string> when;
        for (const u32 v : set.second) {
            layers.push_back(&written[v]);
            when.insert(written[v].when.begin(), written[v].when.end());
        }
        VX_TRY_ASSIGN(BlockLook look, look_with(layers));
        out.push_back({{when.begin(), when.end()}, std::move(look)});
    }
    return out;
}

} // namespace vitrail
