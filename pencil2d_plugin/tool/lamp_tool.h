// The lamp: everything that the artist sees and touches of Lampblack.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/canvas/frame_colours.h"
#include "tool/shot_range.h"
#include "tool/view_mode.h"
#include "worker/worker.h"

#include <QHash>
#include <QPointer>

namespace lampblack
{

class CanvasInput;
class CanvasOverlay;
class KeyInput;
class LampMenu;
class LampPanel;
class MaterialsDock;

/// Puts a tool, its panel, a dock and a menu entry into the host, paints over its canvas while the tool
/// is in use, and edits the document. It asks nobody for pictures: whoever owns it feeds it. The
/// worker's state and the problems of worker and document it follows by itself.
class LampTool : public QObject
{
    Q_OBJECT

public:
    LampTool(Host& host, Worker& worker, SceneDocument& document, QObject* parent = nullptr);
    ~LampTool() override;

    bool isActive() const { return mActive; }
    ViewMode viewMode() const;
    void setViewMode(ViewMode mode);

    QAction* toolAction() { return mTool; }
    QAction* renderAction() { return mRender; } ///< "Render All Frames"
    ShotRange shotRange() const;
    bool hidesSources() const; ///< once the layer of results is there

public Q_SLOTS:
    /// The drawing in sight: where the colour under the pointer comes from, and its camera, which
    /// registers pictures of that frame.
    void setFrame(const lampblack::FrameExport& frame);

    /// A picture to show instead of the drawing. Pictures of another look than viewMode() are passed over.
    void setPicture(const lampblack::LookImage& picture);
    void clearPicture();

    /// What is not lit, under and over what is; null images for nothing.
    void setSurroundings(const lampblack::FrameExport& below, const lampblack::FrameExport& above);

    /// The flat colours of the drawing in sight, most used first.
    void setPalette(const QVector<lampblack::Swatch>& swatches);

    /// Frames done of total; 0 of 0 once the work has ended.
    void setSurfaceProgress(int done, int total);
    void setRenderProgress(int done, int total);

    void showProblem(const lampblack::UserError& error);

Q_SIGNALS:
    void activeChanged(bool active);
    void viewModeChanged(lampblack::ViewMode mode);
    void generateSurfacesRequested();
    void renderAllRequested();
    void cancelRequested();

private:
    void setActive(bool active);
    void makeTool();
    void makePanel();
    void makeDock();
    void makeCanvas();
    void point(const QPointF& canvas);

    Host& mHost;
    Worker& mWorker;
    SceneDocument& mDocument;
    bool mActive = false;
    FrameColours mColours;
    QHash<int, QTransform> mCameras; ///< canvas to image, of frames whose camera has moved
    QAction* mTool;
    QAction* mRender;
    // These belong to the host's window and may go with it.
    QPointer<LampPanel> mPanel;
    QPointer<MaterialsDock> mMaterials;
    QPointer<CanvasOverlay> mOverlay;
    QPointer<CanvasInput> mInput;
    QPointer<KeyInput> mKeys;
    QPointer<LampMenu> mMenu;
};

} // namespace lampblack
