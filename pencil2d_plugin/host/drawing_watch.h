// Tells when the drawing may have changed: a stroke ended, an undo, a paste, a key frame moved.
#pragma once

#include "host/idleness.h"
#include "host/parts.h"

#include <QTimer>

namespace lampblack
{

class DrawingWatch : public QObject
{
    Q_OBJECT

public:
    DrawingWatch(const Parts& parts, Idleness* idleness, QObject* parent);

    /// Strokes are ours, not drawing, while our tool is in use.
    void setToolActive(bool active) { mToolActive = active; }

Q_SIGNALS:
    void changed();       ///< once, a little after the last of a burst
    void layersTouched(); ///< layers may have come, gone, moved or been renamed
    void eyeTouched();    ///< a layer may have been shown or hidden

private Q_SLOTS:
    void touch();
    void touchLayers();

private:
    void onReleased(QObject* where, const Gesture& gesture);
    void onLayerCells(const Gesture& gesture);
    void onKey(int key);

    Parts mParts;
    Idleness* mIdleness;
    QTimer mDebounce;
    QTimer mLayerDebounce;
    bool mToolActive = false;
};

} // namespace lampblack
