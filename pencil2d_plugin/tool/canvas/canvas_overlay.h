// What the lamp paints over the drawing program's canvas: the lit picture and the handles.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/canvas/handles.h"
#include "tool/canvas/lit_picture.h"

#include <QWidget>

namespace lampblack
{

/// A child of the canvas widget that covers it and lets every event through. Shown while the tool is
/// in use.
class CanvasOverlay : public QWidget
{
    Q_OBJECT
    Q_PROPERTY(bool showsPicture READ showsPicture)

public:
    /// `host` has a canvas().
    CanvasOverlay(Host& host, const SceneDocument& document);

    const Handles& handles() const { return mHandles; }
    const std::optional<QTransform>& canvasToWidget() const { return mCanvasToWidget; }
    bool showsPicture() const;

    void setPicture(const LookImage& look, const QTransform& canvasToImage);
    void setSurroundings(const FrameExport& below, const FrameExport& above);
    void clearPicture();

    /// Show the drawing as drawn, for as long as a key is held.
    void setComparing(bool comparing);
    /// The handles step aside while the animation plays.
    void setHandlesShown(bool shown);

    void setHovered(const Handle& handle);
    const Handle& hovered() const { return mHovered; }
    /// A word beside the pointer; empty for none.
    void setTag(const QString& text, const QPointF& beside);

public Q_SLOTS:
    /// The view, the scene or the selection changed.
    void follow();

protected:
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    QRegion handlesRegion() const;

    Host& mHost;
    const SceneDocument& mDocument;
    std::optional<QTransform> mCanvasToWidget;
    LitPicture mPicture;
    Handles mHandles;
    Handle mHovered;
    QString mTag;
    QPointF mTagBeside;
    bool mComparing = false;
    bool mHandlesShown = true;
};

} // namespace lampblack
