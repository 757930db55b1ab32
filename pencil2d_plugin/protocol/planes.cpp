#include "protocol/planes.h"

#include <sodium.h>

#include <array>
#include <cstring>

namespace lampblack::protocol
{
namespace
{

constexpr std::size_t DigestBytes = 20;

QImage::Format imageFormat(Format format)
{
    switch (format)
    {
    case Format::Rgba8:
        return QImage::Format_RGBA8888;
    case Format::Rgba8Premultiplied:
        return QImage::Format_RGBA8888_Premultiplied;
    case Format::A8:
        break;
    }
    return QImage::Format_Alpha8;
}

std::size_t rowBytes(const Plane& plane)
{
    return static_cast<std::size_t>(plane.width) * static_cast<std::size_t>(bytesPerPixel(plane.format));
}

/// The first line of what is hashed of a plane; of a layer, its name follows.
QByteArray title(const Plane& plane)
{
    static constexpr std::array<const char*, 5> Titles = {"pixels rgba8", "mask a8", "ink a8", "",
                                                          "layer rgba8"};
    return QByteArray(Titles.at(static_cast<std::size_t>(plane.role))) + ' ' +
           QByteArray::number(plane.width) + 'x' + QByteArray::number(plane.height);
}

class Blake2b
{
public:
    Blake2b()
    {
        static const int ready = sodium_init(); // chooses the fast implementation
        Q_UNUSED(ready)
        crypto_generichash_init(&mState, nullptr, 0, DigestBytes);
    }

    void add(const void* bytes, std::size_t size)
    {
        crypto_generichash_update(&mState, static_cast<const unsigned char*>(bytes), size);
    }

    QByteArray hex()
    {
        std::array<unsigned char, DigestBytes> digest = {};
        crypto_generichash_final(&mState, digest.data(), digest.size());
        QByteArray raw(static_cast<int>(digest.size()), '\0');
        std::memcpy(raw.data(), digest.data(), digest.size());
        return raw.toHex();
    }

private:
    crypto_generichash_state mState;
};

void addRows(Blake2b& hash, const PlaneView& view)
{
    const auto stride = static_cast<std::size_t>(view.plane.stride);
    const std::size_t row = rowBytes(view.plane);
    const auto height = static_cast<std::size_t>(view.plane.height);
    if (stride == row)
    {
        hash.add(view.bytes, row * height);
        return;
    }
    for (std::size_t y = 0; y < height; ++y)
    {
        hash.add(view.bytes + y * stride, row);
    }
}

} // namespace

Format formatOf(Role role)
{
    switch (role)
    {
    case Role::Pixels:
    case Role::Layer:
        return Format::Rgba8;
    case Role::Picture:
        return Format::Rgba8Premultiplied;
    case Role::Mask:
    case Role::Ink:
        break;
    }
    return Format::A8;
}

int bytesPerPixel(Format format)
{
    return format == Format::A8 ? 1 : 4;
}

PlaneView viewOf(Role role, const QImage& image)
{
    return {{role, formatOf(role), image.width(), image.height(), image.bytesPerLine()}, image.constBits()};
}

QImage toImage(const PlaneView& view)
{
    QImage image(view.plane.width, view.plane.height, imageFormat(view.plane.format));
    for (int y = 0; y < image.height(); ++y)
    {
        const qint64 offset = static_cast<qint64>(y) * view.plane.stride;
        std::memcpy(image.scanLine(y), view.bytes + offset, rowBytes(view.plane));
    }
    return image;
}

QByteArray rowsDigest(const PlaneView& view)
{
    Blake2b hash;
    addRows(hash, view);
    return hash.hex();
}

QByteArray frameDigest(const QVector<PlaneView>& planes, const QStringList& layers)
{
    Blake2b hash;
    int layer = 0;
    for (const PlaneView& view : planes)
    {
        QByteArray line = title(view.plane);
        if (view.plane.role == Role::Layer)
        {
            line += ' ' + layers.value(layer++).toUtf8();
        }
        line += '\n';
        hash.add(line.constData(), static_cast<std::size_t>(line.size()));
        addRows(hash, view);
    }
    return hash.hex();
}

QByteArray frameDigest(const QImage& pixels)
{
    return frameDigest(QVector<PlaneView>{viewOf(Role::Pixels, pixels)});
}

} // namespace lampblack::protocol
