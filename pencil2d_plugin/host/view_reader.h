// The view transform, which Pencil2D keeps to itself.
//
// ViewManager holds, one after another: view, its inverse, view onto the widget, its inverse, and
// the widget's centre, each a QTransform. No getter reaches moc. So the object's own memory is
// searched once for five matrices that relate as these must, through a pipe, which refuses unreadable
// addresses where a load would crash. Another build, with the members elsewhere or otherwise, is
// either found likewise or not found at all.
#pragma once

#include "host/parts.h"

#include <QByteArray>

#include <array>
#include <optional>

namespace lampblack
{

/// The five matrices of ViewManager, in its order.
struct ViewMatrices
{
    QTransform view; ///< Pencil2D's canvas to centred widget, before flips
    QTransform viewInverse;
    QTransform widget; ///< Pencil2D's canvas to widget, logical pixels
    QTransform widgetInverse;
    QTransform centre;
};

/// Copy `size` bytes from `address`; empty if not all of them are readable. Never crashes.
QByteArray readSafely(const void* address, int size);

/// Five matrices from the start of `bytes`, laid out as QTransform lies in Qt 5.
std::optional<ViewMatrices> matricesAt(const QByteArray& bytes, int offset);

/// Whether the five belong together in a widget of this size.
bool agree(const ViewMatrices& matrices, const QSize& widget);

/// Where in `bytes` such five lie under these flips and this zoom (0: unknown); -1 if nowhere, or in
/// more places than one.
int findMatrices(const QByteArray& bytes, const QSize& widget, bool flipX, bool flipY, double zoom);

/// The zoom that the status bar shows, as a factor; 0 if there is none.
double zoomOf(const QString& label);

/// The view as it is painted: unrotated and at a whole zoom, Pencil2D paints its bitmaps at the nearest
/// whole pixel (half a pixel goes up, in logical pixels also on dense screens).
QTransform snapped(const QTransform& widget);

class ViewReader
{
public:
    explicit ViewReader(const Parts& parts) : mParts(parts) {}

    /// The matrices as they are now; nothing while they cannot be told apart.
    std::optional<ViewMatrices> read();

private:
    bool find();

    Parts mParts;
    int mOffset = -1;
};

} // namespace lampblack
