// The lamp tool: all of Lampblack's user interface.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/canvas_tools.h"
#include "tool/light_actions.h"
#include "tool/shot_range.h"
#include "worker/worker.h"

#include <QHash>
#include <QPointer>

namespace lampblack
{

class LampPanel;
class MaterialsDock;

/// Adds a tool, its panel, a dock and a menu entry to the host, paints over the canvas while the tool is in
/// use, and edits the document. It does not request pictures: its owner calls setPicture(). It shows the
/// worker's state, and the problems of worker and document, by itself.
class LampTool : public QObject
{
    Q_OBJECT

public:
    LampTool(Host& host, Worker& worker, SceneDocument& document, QObject* parent = nullptr);
    ~LampTool() override;

    bool isActive() const { return mActive; }
    /// The lamp was put down for another tool, and its light stays on the canvas.
    bool isDrawing() const;
    bool isLighting() const { return mActive || isDrawing(); }
    /// What the canvas shows while the lamp is in use. No value: the drawing as drawn.
    std::optional<Show> viewMode() const;
    void setViewMode(std::optional<Show> mode);
    /// The Depth view: the canvas shows how near the surface is, and its cuts, which can be corrected.
    bool showsDepth() const { return viewMode() == Show::Relief; }
    QVector<Cut> cuts() const { return mCanvas.cuts(); } ///< those that are shown

    QAction* toolAction() { return mTool; }
    QAction* renderAction() { return mActions.render(); } ///< "Render All Frames"
    QAction* keepAction() { return mActions.keep(); }     ///< "Keep the Light While Drawing"
    ShotRange shotRange() const;
    bool hidesSources() const; ///< whether the lit layers are hidden once the result layer is there
    ApartKind apart() const;   ///< what rendered frames are taken apart into

public Q_SLOTS:
    /// The current drawing, for the colour under the pointer. Its camera is remembered for pictures of its
    /// frame.
    void setFrame(const lampblack::FrameExport& frame);

    /// Show a picture instead of the drawing; a null one for none. It is ignored if viewMode() is another
    /// one.
    void setPicture(const lampblack::PreviewImage& picture);
    /// The drawing that the picture was made from, or its stand-in.
    void setDrawn(const lampblack::FrameExport& drawn);
    /// Show a picture, with a camera of its own, where no lit one is; a null picture for none.
    void setStandIn(const lampblack::PreviewImage& picture, const QTransform& canvasToImage);
    void clearPicture();
    /// Whether the picture is what the artist has asked for; otherwise the state is never Ready.
    void setLit(bool lit);

    /// The unlit layers under and over the lit ones; null images for none.
    void setUnlitLayers(const lampblack::FrameExport& below, const lampblack::FrameExport& above);

    /// Where the drawing of a frame overlaps itself.
    void setOverlaps(int frame, const QVector<lampblack::Overlap>& overlaps);

    /// The flat colours of the current drawing, most used first.
    void setPalette(const QVector<lampblack::Swatch>& swatches);

    /// Frames done of total, and the name of the work; 0 of 0 when it has ended.
    void setProgress(const QString& doing, int done, int total);

    /// How many frames of the result layer are out of date, and how many it has.
    void setOutdated(int outdated, int total);

    void showProblem(const lampblack::UserError& error);

Q_SIGNALS:
    void activeChanged(bool active);
    void lightingChanged(bool lighting); ///< isLighting()
    void viewModeChanged();
    void generateSurfacesRequested();
    void renderAllRequested();
    void renderChangedRequested();
    void cancelRequested();

private:
    void setActive(bool active);
    void updateOverlay();
    void addTool();
    void addPanel();
    void addDock();
    void setUpActions();
    void setUpCanvas();
    void updateInput();
    void updateMaterialsHint();
    void updateProgress();
    void settleProblem(UserError::Kind kind);

    Host& mHost;
    Worker& mWorker;
    SceneDocument& mDocument;
    bool mActive = false;
    bool mWasActive = false; ///< and the artist has not put the light away since
    QString mMissing;        ///< why there is no worker, and what to do; empty while there is one
    bool mLighting = false;
    FrameColours mColours;
    QHash<int, QTransform> mCameras; ///< canvas to image, by frame, if not identity
    QAction* mTool;
    LightActions mActions;
    CanvasTools mCanvas;
    // These belong to the host's window and may be deleted with it.
    QPointer<LampPanel> mPanel;
    QPointer<MaterialsDock> mMaterials;
};

} // namespace lampblack
