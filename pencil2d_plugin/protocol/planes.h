// Pixel planes: the raw frames that follow a header (SPEC 3.2), colours in sRGB, rows from the top down.
#pragma once

#include "protocol/generated/messages.h"

#include <QImage>
#include <QVector>

namespace lampblack::protocol
{

/// A plane and where its stride * height bytes lie; it owns nothing.
struct PlaneView
{
    Plane plane;
    const uchar* bytes = nullptr;
};

/// The one format that a role has.
Format formatOf(Role role);
int bytesPerPixel(Format format);

/// How an image is sent: its bits as they lie, padding included. `image` is Format_RGBA8888 for pixels and
/// layers,
/// Format_RGBA8888_Premultiplied for a picture, Format_Alpha8 or Format_Grayscale8 for mask and ink.
/// The view holds no reference: keep the image as long as the view.
PlaneView viewOf(Role role, const QImage& image);

/// A copy of the pixels, the only one made of them; null if memory is short. `view` must have been checked.
QImage toImage(const PlaneView& view);

/// BLAKE2b-160 of a plane's rows without their padding, in hexadecimal.
QByteArray rowsDigest(const PlaneView& view);

/// The name of a frame's content (SPEC 3.3): BLAKE2b-160 of its planes in the order pixels, mask, ink,
/// layers, as 40 lower-case hexadecimal digits. `layers` has a name for each plane of a layer. Takes 1 to
/// 3 ms a megabyte: not for the UI thread.
QByteArray frameDigest(const QVector<PlaneView>& planes, const QStringList& layers = {});

/// The digest of a drawing without mask and ink; `pixels` is Format_RGBA8888.
QByteArray frameDigest(const QImage& pixels);

} // namespace lampblack::protocol
