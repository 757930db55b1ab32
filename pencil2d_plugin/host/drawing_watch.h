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
    void layersTouched(); ///< the list of layers was clicked, or its length changed

private Q_SLOTS:
    void touch();
    void touchLayers();

private:
    void onReleased(QObject* where);
    void onKey(int key);

    Parts mParts;
    Idleness* mIdleness;
    QTimer mDebounce;
    QTimer mLayerDebounce;
    bool mToolActive = false;
};

} // namespace lampblack
