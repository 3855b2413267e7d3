// SPDX-License-Identifier: MIT
// The C++ side of pictures. Every file is encoded in memory first: then one place writes bytes and
// sees every error of the disk, and standard output works for all formats.
#include "image/oiio.h"

#include "image/stored.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

struct OiioReader {
    std::unique_ptr<OIIO::ImageInput> input;
};

namespace {

// ORDER image_format (PNG and PPM are not written here)
const char *const plugins[] = {"", "targa", "", "bmp", "jpeg", "openexr", "hdr", "tiff"};

void explain(char why[OIIO_WHY], const std::string &text) {
    std::string line = text.empty() ? std::string("unknown error") : text;
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::snprintf(why, OIIO_WHY, "%s", line.c_str());
}

bool is_float_format(ImageFormat format) { return format == IMAGE_EXR || format == IMAGE_HDR; }

OIIO::TypeDesc file_type(const ImageWriteOptions &options) {
    if (options.format == IMAGE_EXR)
        return OIIO::TypeHalf;
    if (options.format == IMAGE_HDR)
        return OIIO::TypeFloat;
    bool deep = options.bits > 8 && options.format == IMAGE_TIFF;
    return deep ? OIIO::TypeUInt16 : OIIO::TypeUInt8;
}

template <class Integer>
std::vector<unsigned char> store(const Image &image, int bits, int channels) {
    size_t pixels = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
    std::vector<unsigned char> bytes(pixels * static_cast<size_t>(channels) * sizeof(Integer));
    Integer *out = reinterpret_cast<Integer *>(bytes.data());
    const float *in = image.pixels;
    for (size_t i = 0; i < pixels; i++, in += image.channels)
        for (int c = 0; c < channels; c++)
            *out++ = static_cast<Integer>(
                image_stored(in[c], bits, static_cast<int>(8 * sizeof(Integer))));
    return bytes;
}

void describe(OIIO::ImageSpec &spec, const ImageWriteOptions &options) {
    spec.attribute("oiio:UnassociatedAlpha", is_float_format(options.format) ? 0 : 1);
    if (options.software)
        spec.attribute("Software", options.software);
    if (options.comment)
        spec.attribute("ImageDescription", options.comment);
    if (options.format == IMAGE_TIFF) {
        // A colour space makes it add a second directory, which it cannot do in memory.
    } else if (options.srgb) {
        spec.attribute("oiio:ColorSpace", "sRGB");
    } else if (options.gamma == 1.0) {
        spec.attribute("oiio:ColorSpace", "Linear");
    } else if (options.gamma > 0.0) {
        spec.attribute("oiio:ColorSpace", "GammaCorrected");
        spec.attribute("oiio:Gamma", static_cast<float>(options.gamma));
    }
    if (options.format == IMAGE_TGA)
        spec.attribute("compression", options.compressed ? "rle" : "none");
    if (options.format == IMAGE_EXR) {
        spec.attribute("compression", "zip");
        spec.attribute("DateTime", ""); // as in encode_exr
    }
    if (options.format == IMAGE_TIFF)
        spec.attribute("compression", "zip");
    if (options.format == IMAGE_JPEG) {
        // Little loss, and none of it in the colours' resolution: these pictures get compared.
        spec.attribute("compression", "jpeg:95");
        spec.attribute("jpeg:subsampling", "4:4:4");
    }
}

bool encode(const Image &image, const ImageWriteOptions &options, std::vector<unsigned char> &bytes,
            std::string &error) {
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(plugins[options.format]);
    if (!output || !output->supports("ioproxy")) {
        error = output ? "this OpenImageIO cannot encode it in memory" : OIIO::geterror();
        return false;
    }
    // Alpha is dropped where the format has no place for it.
    int channels = image.channels;
    if (!output->supports("alpha") && (channels == 2 || channels == 4))
        channels--;
    OIIO::TypeDesc type = file_type(options);
    OIIO::ImageSpec spec(image.width, image.height, channels, type);
    describe(spec, options);

    OIIO::Filesystem::IOVecOutput proxy(bytes);
    if (!output->set_ioproxy(&proxy) || !output->open("picture", spec)) {
        error = output->geterror();
        return false;
    }
    bool ok;
    if (is_float_format(options.format)) {
        OIIO::stride_t step = static_cast<OIIO::stride_t>(sizeof(float)) * image.channels;
        ok = output->write_image(OIIO::TypeFloat, image.pixels, step);
    } else if (type == OIIO::TypeUInt16) {
        ok = output->write_image(type, store<uint16_t>(image, options.bits, channels).data());
    } else {
        ok = output->write_image(type, store<uint8_t>(image, options.bits, channels).data());
    }
    ok = output->close() && ok;
    if (!ok)
        error = output->geterror();
    return ok;
}

bool encode_exr(const ImageLayers &layers, const char *software, std::vector<unsigned char> &bytes,
                std::string &error) {
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("openexr");
    OIIO::ImageSpec spec(layers.width, layers.height, layers.channels, OIIO::TypeFloat);
    spec.channelnames.assign(layers.names, layers.names + layers.channels);
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", ""); // else it is the hour: the same picture is the same bytes
    if (software)
        spec.attribute("Software", software);
    OIIO::Filesystem::IOVecOutput proxy(bytes);
    if (!output || !output->set_ioproxy(&proxy) || !output->open("picture", spec)) {
        error = output ? output->geterror() : OIIO::geterror();
        return false;
    }
    bool ok = output->write_image(OIIO::TypeFloat, layers.pixels);
    ok = output->close() && ok;
    if (!ok)
        error = output->geterror();
    return ok;
}

OIIO::ImageBuf wrap(const Image &image) {
    return OIIO::ImageBuf(
        OIIO::ImageSpec(image.width, image.height, image.channels, OIIO::TypeFloat), image.pixels);
}

// The bytes that `fill` encodes, to out.
template <class Fill> bool write_bytes(FILE *out, char why[OIIO_WHY], Fill fill) {
    why[0] = '\0';
    try {
        std::vector<unsigned char> bytes;
        std::string error;
        if (!fill(bytes, error)) {
            explain(why, error);
            return false;
        }
        return std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size();
    } catch (const std::exception &failure) {
        explain(why, failure.what());
        return false;
    }
}

bool encode_to(const Image *image, const ImageWriteOptions *options, FILE *out,
               char why[OIIO_WHY]) noexcept {
    return write_bytes(out, why, [=](std::vector<unsigned char> &bytes, std::string &error) {
        return encode(*image, *options, bytes, error);
    });
}

bool encode_layers_to(const ImageLayers *layers, const char *software, FILE *out,
                      char why[OIIO_WHY]) noexcept {
    return write_bytes(out, why, [=](std::vector<unsigned char> &bytes, std::string &error) {
        return encode_exr(*layers, software, bytes, error);
    });
}

OiioReader *open_reader(const char *path, int *width, int *height, int *channels, int *bits,
                        char why[OIIO_WHY]) noexcept {
    try {
        OIIO::ImageSpec hints;
        hints.attribute("oiio:UnassociatedAlpha", 1);
        std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &hints);
        if (!input) {
            explain(why, OIIO::geterror());
            return nullptr;
        }
        const OIIO::ImageSpec &spec = input->spec();
        *width = spec.width;
        *height = spec.height;
        *channels = spec.nchannels;
        *bits = static_cast<int>(8 * spec.format.basesize());
        return new OiioReader{std::move(input)};
    } catch (const std::exception &failure) {
        explain(why, failure.what());
        return nullptr;
    }
}

bool read_pixels(OiioReader *reader, int channels, float *pixels, char why[OIIO_WHY]) noexcept {
    std::unique_ptr<OiioReader> owner(reader);
    try {
        if (owner->input->read_image(0, 0, 0, channels, OIIO::TypeFloat, pixels))
            return true;
        explain(why, owner->input->geterror());
    } catch (const std::exception &failure) {
        explain(why, failure.what());
    }
    return false;
}

void close_reader(OiioReader *reader) noexcept { delete reader; }

// Yee's metric wants linear colours.
OIIO::ImageBuf linear(const Image &image) {
    OIIO::ImageBuf out(OIIO::ImageSpec(image.width, image.height, 3, OIIO::TypeFloat));
    const size_t channels = static_cast<size_t>(image.channels);
    const float *in = image.pixels;
    for (int y = 0; y < image.height; y++)
        for (int x = 0; x < image.width; x++, in += channels) {
            float rgb[3];
            for (int c = 0; c < 3; c++)
                rgb[c] = image.bits == 32    ? in[c]
                         : in[c] <= 0.04045f ? in[c] / 12.92f
                                             : std::pow((in[c] + 0.055f) / 1.055f, 2.4f);
            out.setpixel(x, y, rgb, 3);
        }
    return out;
}

// Its pyramid of filtered pictures needs some room.
constexpr int least_for_yee = 32;

int64_t perceptible(const Image &a, const Image &b) {
    if (a.channels < 3 || a.width < least_for_yee || a.height < least_for_yee)
        return -1;
    OIIO::ImageBufAlgo::CompareResults found;
    return OIIO::ImageBufAlgo::compare_Yee(linear(a), linear(b), found);
}

bool compare_images(const Image *a, const Image *b, double fail, double warn,
                    ImageDifference *result, char why[OIIO_WHY]) noexcept {
    try {
        const OIIO::ImageBuf one = wrap(*a), two = wrap(*b);
        OIIO::ImageBufAlgo::CompareResults found = OIIO::ImageBufAlgo::compare(
            one, two, static_cast<float>(fail), static_cast<float>(warn));
        // found.error only says that some pixel failed.
        if (one.has_error() || two.has_error()) {
            explain(why, one.has_error() ? one.geterror() : two.geterror());
            return false;
        }
        result->mean = found.meanerror;
        result->rms = found.rms_error;
        result->psnr = found.PSNR;
        result->max = found.maxerror;
        result->max_x = found.maxx;
        result->max_y = found.maxy;
        result->max_channel = found.maxc;
        result->warned = found.nwarn;
        result->failed = found.nfail;
        result->perceptible = found.maxerror > 0 ? perceptible(*a, *b) : a->channels < 3 ? -1 : 0;
        return true;
    } catch (const std::exception &failure) {
        explain(why, failure.what());
        return false;
    }
}

bool color_values(const Image *values, Image *colors, char why[OIIO_WHY]) noexcept {
    try {
        OIIO::ImageBuf in = wrap(*values), out = wrap(*colors);
        if (OIIO::ImageBufAlgo::color_map(out, in, 0, "inferno"))
            return true;
        explain(why, out.geterror());
    } catch (const std::exception &failure) {
        explain(why, failure.what());
    }
    return false;
}

} // namespace

const OiioTable oiio_table = {encode_to,    encode_layers_to, open_reader, read_pixels,
                              close_reader, compare_images,   color_values};
