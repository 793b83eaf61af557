// The base game's content as the tracer sees it, loaded once for all tests.
#pragma once

#include "scene/block_pictures.h"
#include "script/content_loader.h"
#include "trace/content/content_tables.h"
#include "trace/grid/grid.h"
#include "trace/lights/light_store.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <memory>
#include <string>

namespace vitrail::trace {

struct BaseContent {
    std::shared_ptr<BlockRegistry> registry;
    std::unique_ptr<StateTable> states;
    scene::BlockModels models;
    scene::BlockPictures pictures;
    ContentTables tables;
    SceneView scene; // states, quads, media, textures

    // The state, with defaults for what the text leaves out; there from the start.
    u32 id(const std::string& text) const {
        BlockState state = parse_block_state(text).value();
        const BlockDef& def = registry->blocks()[u32(registry->find_block(state.name))];
        for (const PropertyDef& p : def.properties)
            if (state.get(p.name).empty()) state.set(p.name, p.default_value);
        const auto found = states->find(state.to_string());
        EXPECT_TRUE(found) << text;
        return found ? u32(*found) : 0;
    }
    const StateRecord& record(const std::string& text) const { return tables.states()[id(text)]; }
};

// Every state of every block.
inline BaseContent& base_content() {
    // Goes at the end: state tables keep what they own where leak checkers do not look.
    static const std::unique_ptr<BaseContent> content = [] {
        auto c = std::make_unique<BaseContent>();
        const std::filesystem::path root = std::string(VITRAIL_SOURCE_DIR) + "/content/base";
        c->registry = load_content({&root, 1}).value().registry;
        c->registry->content_roots = {root.string()};
        c->states = std::make_unique<StateTable>(c->registry);
        for (const BlockDef& def : c->registry->blocks()) {
            std::vector<std::size_t> digits(def.properties.size(), 0);
            for (bool more = true; more;) {
                BlockState state{def.name, {}};
                for (std::size_t i = 0; i < digits.size(); ++i)
                    state.set(def.properties[i].name, def.properties[i].values[digits[i]]);
                EXPECT_TRUE(c->states->intern(state));
                more = false;
                for (std::size_t i = 0; i < digits.size() && !more; ++i) {
                    if (++digits[i] < def.properties[i].values.size())
                        more = true;
                    else
                        digits[i] = 0;
                }
            }
        }
        c->models.ensure(*c->states);
        c->pictures = scene::BlockPictures::load(*c->registry, nullptr);
        EXPECT_TRUE(c->tables.update(c->models, *c->states, &c->pictures));
        c->tables.fill(c->scene);
        return c;
    }();
    return *content;
}

// One chunk, at 0, of the base content's blocks.
class ContentChunk {
public:
    void set(i32 x, i32 y, i32 z, const std::string& state) {
        blocks_.set(LocalPos(x, y, z), StateId(base_content().id(state)));
    }
    const BlockStorage& blocks() const { return blocks_; }
    // tints: kTintWords words, or null. Valid until the next call.
    const SceneView& scene(const u32* tints = nullptr) {
        const ContentTables& tables = base_content().tables;
        grid_.set_states(tables.states(), tables.media());
        grid_.center_on({0, 0, 0});
        const Grid::Item item{{0, 0, 0}, &blocks_, tints};
        grid_.set_chunks({&item, 1});
        view_ = base_content().scene;
        view_.grid = grid_.view();
        return view_;
    }

    // With its lamps, which `lights` holds.
    SceneView lit_scene(LightStore& lights) {
        SceneView view = scene();
        lights.set_states(view, u32(base_content().tables.quads().size()));
        auto all = std::make_shared<Chunk>();
        all->blocks = blocks_;
        lights.mark({0, 0, 0}, std::move(all));
        lights.update(view.grid);
        view.lights = lights.view();
        return view;
    }

private:
    BlockStorage blocks_;
    Grid grid_{GridShape{2, 2, 2}};
    SceneView view_;
};

} // namespace vitrail::trace
