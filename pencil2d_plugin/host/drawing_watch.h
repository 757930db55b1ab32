// Detects that the drawing may have changed: after a stroke, an undo, a paste, a moved key frame.
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

    /// While our tool is active, strokes on the canvas are not drawing.
    void setToolActive(bool active) { mToolActive = active; }

Q_SIGNALS:
    void changed();            ///< emitted once, shortly after the last of several changes
    void manyChanged();        ///< emitted instead: drawings of other frames may have changed too
    void layersMaybeChanged(); ///< layers may have been added, removed, moved or renamed
    void eyeMaybeChanged();    ///< a layer may have been shown or hidden

private Q_SLOTS:
    void onEdited();
    void onManyEdited();
    void onFramesModified();
    void onLayersEdited();

private:
    void onReleased(QObject* widget, const Gesture& gesture);
    void onLayerCells(const Gesture& gesture);
    void onKeyReleased(int key);

    Parts mParts;
    Idleness* mIdleness;
    QTimer mChangeTimer;
    QTimer mLayersTimer;
    bool mToolActive = false;
    bool mManyChanged = false;
};

} // namespace lampblack
