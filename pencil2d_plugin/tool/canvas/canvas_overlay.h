// Paints the picture and what the artist can take hold of over the canvas of the drawing program.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/canvas/handles.h"
#include "tool/canvas/light_layer.h"
#include "tool/canvas/lit_picture.h"
#include "tool/depth/brush_painter.h"
#include "tool/depth/cuts.h"

#include <QWidget>

namespace lampblack
{

/// A child widget that covers the canvas and is transparent for events. Shown while the tool is in use.
class CanvasOverlay : public QWidget
{
    Q_OBJECT
    Q_PROPERTY(bool showsPicture READ showsPicture)
    Q_PROPERTY(bool showsStandIn READ showsStandIn)

public:
    /// host.canvas() must not be null.
    CanvasOverlay(Host& host, const SceneDocument& document);

    const Handles& handles() const { return mHandles; }
    const std::optional<QTransform>& canvasToWidget() const { return mCanvasToWidget; }
    bool showsPicture() const;
    bool showsStandIn() const; ///< and no picture

    void setPicture(const PreviewImage& image, const QTransform& canvasToImage);
    void setUnlitLayers(const FrameExport& below, const FrameExport& above);
    /// What is shown where the picture does not reach; a null picture for nothing.
    void setStandIn(const PreviewImage& image, const QTransform& canvasToImage);
    /// The drawing that both were made from; a null image if it is not known.
    void setDrawn(const FrameExport& drawn);
    void clearPicture();

    /// While the artist draws there is only the light, on whatever the canvas shows.
    void setDrawing(bool drawing);

    /// While comparing, the drawing is shown as drawn.
    void setComparing(bool comparing);
    /// Handles and cuts are hidden while the animation plays.
    void setPlaying(bool playing);

    /// Show cuts instead of the handles.
    void setCutsShown(bool shown);
    void setCuts(const QVector<Cut>& cuts);
    void setHoveredCut(int cut);              ///< index, or -1
    void setCutStroke(const QPolygonF& line); ///< that is being drawn, canvas pixels; empty for none

    /// Show the brush instead of handles and cuts; no value for none.
    void setBrush(const std::optional<BrushView>& brush);

    void setHovered(const Handle& handle);
    const Handle& hovered() const { return mHovered; }
    /// A short text beside the pointer; empty for none.
    void setTag(const QString& text, const QPointF& position);

public Q_SLOTS:
    /// Call after a change of the view, the scene or the selection.
    void updateHandles();

protected:
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    QRegion handlesRegion() const;
    void followPicture();
    void paintGuides(QPainter& painter) const;
    bool showsLayer() const;

    Host& mHost;
    const SceneDocument& mDocument;
    std::optional<QTransform> mCanvasToWidget;
    LitPicture mPicture;
    LightLayer mLayer;
    Handles mHandles;
    Handle mHovered;
    QString mTag;
    QPointF mTagPosition;
    bool mComparing = false;
    bool mDrawing = false;
    bool mPlaying = false;
    bool mCutsShown = false;
    QVector<Cut> mCuts;
    int mHoveredCut = -1;
    QPolygonF mCutStroke;
    std::optional<BrushView> mBrush;
};

} // namespace lampblack
