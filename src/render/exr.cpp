#include "render/exr.h"

#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <half.h>

namespace vitrail::render {

namespace {

constexpr float kHalfMost = 65504;

half to_half(float v) {
    return half(v == v ? std::clamp(v, -kHalfMost, kHalfMost) : 0.0f);
}

void write(const std::string& path, const ExrPicture& picture) {
    Imf::Header header(int(picture.width), int(picture.height), 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y,
                       Imf::ZIP_COMPRESSION);
    for (const auto& [name, text] : picture.texts)
        header.insert(name.c_str(), Imf::StringAttribute(text));
    for (const auto& [name, number] : picture.numbers)
        header.insert(name.c_str(), Imf::FloatAttribute(number));
    for (const auto& [name, count] : picture.counts)
        header.insert(name.c_str(), Imf::IntAttribute(count));
    Imf::FrameBuffer buffer;
    std::vector<std::vector<half>> halves;
    halves.reserve(picture.layers.size()); // slices point into them
    for (const ExrLayer& layer : picture.layers) {
        const std::size_t channels = layer.names.size();
        const char* base = reinterpret_cast<const char*>(layer.values.data());
        std::size_t bytes = sizeof(float);
        if (layer.half) {
            auto& made = halves.emplace_back(layer.values.size());
            std::transform(layer.values.begin(), layer.values.end(), made.begin(), to_half);
            base = reinterpret_cast<const char*>(made.data()), bytes = sizeof(half);
        }
        const Imf::PixelType type = layer.half ? Imf::HALF : Imf::FLOAT;
        for (std::size_t c = 0; c < channels; ++c) {
            header.channels().insert(layer.names[c], Imf::Channel(type));
            // The library only reads from it.
            buffer.insert(layer.names[c], Imf::Slice(type, const_cast<char*>(base + c * bytes), bytes * channels,
                                                     bytes * channels * picture.width));
        }
    }
    Imf::OutputFile file(path.c_str(), header, 0);
    file.setFrameBuffer(buffer);
    file.writePixels(int(picture.height));
}

} // namespace

Result<> write_exr(const std::string& path, const ExrPicture& picture) {
    for (const ExrLayer& layer : picture.layers)
        if (layer.names.empty() ||
            layer.values.size() != std::size_t(picture.width) * picture.height * layer.names.size())
            return fail(ErrorCode::invalid_argument, "a layer of another size than the picture");
    const std::string unfinished = path + ".part";
    try {
        write(unfinished, picture);
    } catch (const std::exception& error) {
        std::remove(unfinished.c_str());
        return fail(ErrorCode::io, fmt::format("{}: cannot be written: {}", path, error.what()));
    }
    if (std::rename(unfinished.c_str(), path.c_str()) == 0) return {};
    std::remove(unfinished.c_str());
    return fail(ErrorCode::io, fmt::format("{}: cannot be written", path));
}

Result<ExrPicture> read_exr(const std::string& path) {
    try {
        Imf::InputFile file(path.c_str(), 0);
        const Imath::Box2i window = file.header().dataWindow();
        const i64 width = i64(window.max.x) - window.min.x + 1, height = i64(window.max.y) - window.min.y + 1;
        if (width < 1 || height < 1 || width > 16384 || height > 16384)
            return fail(ErrorCode::damaged, fmt::format("{}: a picture of {}x{}", path, width, height));
        ExrPicture picture;
        picture.width = u32(width), picture.height = u32(height);
        const Imf::ChannelList& channels = file.header().channels();
        for (auto c = channels.begin(); c != channels.end(); ++c) {
            ExrLayer layer;
            layer.names = {c.name()};
            layer.half = c.channel().type == Imf::HALF;
            layer.values.resize(std::size_t(width * height));
            picture.layers.push_back(std::move(layer));
        }
        Imf::FrameBuffer buffer;
        for (ExrLayer& layer : picture.layers)
            buffer.insert(layer.names[0], Imf::Slice::Make(Imf::FLOAT, layer.values.data(), window, sizeof(float),
                                                           sizeof(float) * std::size_t(width)));
        file.setFrameBuffer(buffer);
        file.readPixels(window.min.y, window.max.y);
        for (auto a = file.header().begin(); a != file.header().end(); ++a) {
            if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
                picture.texts[a.name()] = text->value();
            if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&a.attribute()))
                picture.numbers[a.name()] = number->value();
            if (const auto* count = dynamic_cast<const Imf::IntAttribute*>(&a.attribute()))
                picture.counts[a.name()] = count->value();
        }
        return picture;
    } catch (const std::exception& error) {
        return fail(ErrorCode::damaged, fmt::format("{}: {}", path, error.what()));
    }
}

} // namespace vitrail::render
