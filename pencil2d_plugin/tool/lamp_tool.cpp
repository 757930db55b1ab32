#include "tool/lamp_tool.h"

#include "tool/canvas/canvas_input.h"
#include "tool/canvas/canvas_overlay.h"
#include "tool/canvas/key_input.h"
#include "tool/canvas/lamp_menu.h"
#include "tool/depth/brush_bar.h"
#include "tool/depth/brush_editor.h"
#include "tool/depth/cut_editor.h"
#include "tool/depth/cut_menu.h"
#include "tool/materials/materials_dock.h"
#include "tool/panel/lamp_panel.h"
#include "tool/panel/light_links.h"
#include "tool/panel/rig_menu.h"
#include "tool/panel/rig_pictures.h"

#include <utility>

// Resources of a static library must be initialised, and from outside any namespace.
static void initIcons()
{
    Q_INIT_RESOURCE(lampblack_icons);
}

namespace lampblack
{

namespace
{
constexpr int ProblemMs = 10000; ///< how long the status bar shows a problem
}

LampTool::LampTool(Host& host, Worker& worker, SceneDocument& document, QObject* parent)
    : QObject(parent), mHost(host), mWorker(worker), mDocument(document), mTool(new QAction(this)),
      mSurfaces(new QAction(this)), mRender(new QAction(this)), mCancel(new QAction(this)),
      mKeep(new QAction(this))
{
    initIcons();
    addActions();
    addTool();
    addPanel();
    addDock();
    setUpCanvas();
    connect(&worker, &Worker::problem, this, &LampTool::showProblem);
    connect(&document, &SceneDocument::problem, this, &LampTool::showProblem);
    connect(&host, &Host::toolActivated, this, &LampTool::setActive);
    connect(&host, &Host::projectOpened, this,
            [this]
            {
                mWasActive = mActive; // another project is drawn in the light only once it was lit
                updateOverlay();
                setPalette({}); // its colours were those of the project before
                settleProblem(UserError::Kind::NothingDrawn);
            });
    connect(&worker, &Worker::imageArrived, this,
            [this](const PreviewImage& image)
            {
                if (image.frame == mHost.currentFrame())
                    settleProblem(UserError::Kind::NothingDrawn);
            });
    for (const auto signal : {&Host::drawingChanged, &Host::frameChanged})
        connect(&host, signal, this, [this] { settleProblem(UserError::Kind::NothingDrawn); });
}

LampTool::~LampTool()
{
    delete mBrushBar;
    delete mOverlay; // deletes the event filters of the canvas too
    delete mMenu;
    delete mCutMenu;
    delete mProgress;
    delete mMaterials;
    delete mPanel;
}

void LampTool::addActions()
{
    const auto add = [this](QAction* action, const QString& name, const QString& text, const QString& hint)
    {
        action->setObjectName(name);
        action->setText(text);
        action->setToolTip(hint);
        mHost.addLightAction(action);
    };
    add(mSurfaces, QStringLiteral("lampblack.surfaces"), tr("Generate Surfaces"),
        tr("Model every frame now, so that scrubbing and playing are lit at once."));
    add(mRender, QStringLiteral("lampblack.render"), tr("Render All Frames"),
        tr("Light every frame at the chosen quality, into a layer \"Lit\" and image files beside the "
           "project"));
    add(mCancel, QStringLiteral("lampblack.cancel"), tr("Cancel"),
        tr("Stop generating or rendering. Frames that are done are kept."));
    mCancel->setEnabled(false);
    add(mKeep, QStringLiteral("lampblack.keep_light"), tr("Keep the Light While Drawing"),
        tr("Once the lamp was used, its light stays on the canvas while you draw"));
    mKeep->setCheckable(true);
    mKeep->setChecked(true);
    connect(mKeep, &QAction::toggled, this, &LampTool::updateOverlay);
    connect(mSurfaces, &QAction::triggered, this, &LampTool::generateSurfacesRequested);
    connect(mRender, &QAction::triggered, this, &LampTool::renderAllRequested);
    connect(mCancel, &QAction::triggered, this, &LampTool::cancelRequested);
    mProgress = new JobProgress(QStringLiteral("lampblack.status"), true);
    connect(mProgress, &JobProgress::cancelRequested, this, &LampTool::cancelRequested);
    mHost.addStatusWidget(mProgress);
}

void LampTool::addTool()
{
    mTool->setObjectName(QStringLiteral("lampblack.tool"));
    mTool->setCheckable(true);
    mTool->setText(tr("Lamp"));
    mTool->setIcon(QIcon(QStringLiteral(":/lampblack/lamp.svg")));
    mTool->setShortcut(Qt::Key_L);
    mTool->setToolTip(tr("<b>Lamp Tool (L)</b><br>Light the drawing"));
    mTool->setStatusTip(
        tr("Drag a light to move it, turn the wheel over it for its height, right-click for more"));
    mHost.addTool(mTool);
    if (!mHost.can(Host::Ability::Palette))
        mHost.addLightAction(mTool);
}

void LampTool::addPanel()
{
    mPanel = new LampPanel(mHost, mDocument, *mSurfaces, *mRender);
    connect(mPanel, &LampPanel::viewModeChanged, this, &LampTool::setViewMode);
    connect(mPanel->render(), &RenderSection::renderChangedRequested, this,
            &LampTool::renderChangedRequested);
    connect(mPanel->progress(), &JobProgress::cancelRequested, this, &LampTool::cancelRequested);
    connect(&mWorker, &Worker::stateChanged, mPanel.data(), &LampPanel::setWorkerState);
    connect(mPanel, &LampPanel::retryRequested, &mWorker, &Worker::start);
    mPanel->setWorkerState(mWorker.state());
    if (auto* rigs = mPanel->findChild<RigMenu*>())
    {
        rigs->setFigure([this] { return mColours.drawnBox(); });
        new RigPictures(mHost, mWorker, *rigs);
    }
    if (mHost.can(Host::Ability::Panel))
    {
        mHost.setToolPanel(mPanel);
        return;
    }
    auto* dock = new QDockWidget(tr("Lamp"));
    dock->setObjectName(QStringLiteral("lampblack.panel.dock"));
    dock->setWidget(mPanel);
    mHost.addDock(dock);
}

void LampTool::addDock()
{
    mMaterials = new MaterialsDock(mDocument);
    connect(mMaterials, &MaterialsDock::pickRequested, this,
            [this](bool picking)
            {
                if (picking && !mActive)
                    mTool->trigger();
                if (picking && showsDepth())
                    setViewMode(Show::Lit);
                if (mInput)
                    mInput->setPicking(picking && mActive);
                if (picking && mMaterials)
                    mMaterials->setPicking(mInput && mInput->isPicking());
            });
    mHost.addDock(mMaterials);
}

void LampTool::setUpCanvas()
{
    if (mHost.canvas() == nullptr)
        return;
    mOverlay = new CanvasOverlay(mHost, mDocument);
    mInput = new CanvasInput(mHost, mDocument, *mOverlay);
    mCuts = new CutEditor(mHost, mDocument, *mOverlay);
    mBrush = new BrushEditor(mHost, mDocument, *mOverlay);
    mKeys = new KeyInput(mHost, mDocument, *mOverlay, *mInput, mCuts, mBrush);
    mMenu = new LampMenu(mHost, mDocument, mHost.canvas());
    connect(&mHost, &Host::playingChanged, mOverlay.data(),
            [this](bool playing) { mOverlay->setPlaying(playing); });
    connect(mInput, &CanvasInput::menuRequested, mMenu.data(),
            [this](const QPointF& canvas, const QPoint& global, const Handle& handle)
            { mMenu->openAt(canvas, global, handle, mColours.at(canvas)); });
    connect(mInput, &CanvasInput::pointerMoved, this, &LampTool::highlightColourAt);
    connect(mInput, &CanvasInput::pointerLeft, this,
            [this]
            {
                if (mMaterials)
                    mMaterials->setHighlighted(QString());
            });
    connect(mInput, &CanvasInput::colourPicked, this,
            [this](const QPointF& canvas)
            {
                if (mMaterials)
                    mMaterials->revealColour(mColours.at(canvas));
            });
    connect(mInput, &CanvasInput::pickingChanged, this,
            [this](bool picking)
            {
                if (mMaterials)
                    mMaterials->setPicking(picking);
            });
    connect(mMenu, &LampMenu::editMaterialRequested, this,
            [this](const QString& colour)
            {
                if (mMaterials)
                    mMaterials->revealColour(colour);
            });
    setUpCuts();
}

void LampTool::setUpCuts()
{
    mCutMenu = new CutMenu(mHost, mDocument, *mCuts, mHost.canvas());
    connect(mCuts, &CutEditor::menuRequested, mCutMenu.data(),
            [this](const Cut* cut, const QPoint& global)
            { mCutMenu->openAt(cut, global, colourAt(global)); });
    connect(mBrush, &BrushEditor::menuRequested, mCutMenu.data(),
            [this](int stroke, const QPoint& global)
            { mCutMenu->openAtStroke(stroke, global, colourAt(global)); });
    mBrushBar = new BrushBar(mHost.canvas());
    connect(mBrushBar, &BrushBar::brushChosen, this,
            [this](std::optional<Brush> brush)
            {
                if (brush)
                    mBrush->setBrush(*brush);
                updateInput();
            });
    connect(mCutMenu, &CutMenu::lightRequested, this, [this] { setViewMode(Show::Lit); });
    connect(mMenu, &LampMenu::depthRequested, this, [this] { setViewMode(Show::Relief); });
}

QString LampTool::colourAt(const QPoint& global) const
{
    const std::optional<QTransform> toWidget = mHost.canvasToWidget();
    if (!toWidget || !toWidget->isInvertible())
        return {};
    return mColours.at(toWidget->inverted().map(QPointF(mHost.canvas()->mapFromGlobal(global))));
}

void LampTool::updateInput()
{
    mHost.showStatus(mActive ? mTool->statusTip() : QString());
    if (!mOverlay)
        return;
    const bool depth = mActive && showsDepth();
    // Who had the cursor gives it back first.
    if (depth)
        mInput->setListening(false);
    const bool brush = depth && mBrushBar && mBrushBar->brush();
    if (brush)
        mCuts->setListening(false);
    else
        mBrush->setListening(false);
    mCuts->setListening(depth && !brush);
    mBrush->setListening(brush);
    if (mBrushBar)
    {
        mBrushBar->setVisible(depth);
        mBrushBar->raise();
    }
    mInput->setListening(mActive && !depth);
}

void LampTool::setActive(bool active)
{
    if (active == mActive)
        return;
    mActive = active;
    mWasActive = true;
    if (mOverlay)
        mKeys->setListening(active);
    updateOverlay();
    updateInput();
    updateProgress();
    Q_EMIT activeChanged(active);
}

bool LampTool::isDrawing() const
{
    return !mActive && mWasActive && mKeep->isChecked() && viewMode() == Show::Lit;
}

void LampTool::updateOverlay()
{
    if (mOverlay)
    {
        mOverlay->setDrawing(isDrawing());
        mOverlay->setVisible(isLighting());
        mOverlay->raise();
        mOverlay->updateHandles();
    }
    if (std::exchange(mLighting, isLighting()) != isLighting())
        Q_EMIT lightingChanged(mLighting);
}

std::optional<Show> LampTool::viewMode() const
{
    return mPanel ? mPanel->viewMode() : std::nullopt;
}

void LampTool::setViewMode(std::optional<Show> mode)
{
    if (mPanel)
        mPanel->setViewMode(mode);
    if (mOverlay)
        mOverlay->clearPicture();
    updateInput();
    Q_EMIT viewModeChanged();
}

ShotRange LampTool::shotRange() const
{
    return mPanel ? mPanel->render()->range() : ShotRange::All;
}

bool LampTool::hidesSources() const
{
    return mPanel && mPanel->render()->hidesSources();
}

ApartKind LampTool::apart() const
{
    return mPanel ? mPanel->render()->apart() : ApartKind::None;
}

void LampTool::setFrame(const FrameExport& frame)
{
    mColours.setFrame(frame);
    if (mCuts)
        mCuts->setFrame(frame);
    if (frame.canvasToImage.isIdentity())
        mCameras.remove(frame.frame);
    else
        mCameras.insert(frame.frame, frame.canvasToImage);
}

void LampTool::setPicture(const PreviewImage& picture)
{
    if (!mOverlay || (!picture.picture.isNull() && picture.show != viewMode()))
        return;
    mOverlay->setPicture(picture, mCameras.value(picture.frame));
}

void LampTool::setStandIn(const PreviewImage& picture, const QTransform& canvasToImage)
{
    if (mOverlay)
        mOverlay->setStandIn(picture, canvasToImage);
}

void LampTool::setDrawn(const FrameExport& drawn)
{
    if (mOverlay)
        mOverlay->setDrawn(drawn);
}

void LampTool::clearPicture()
{
    if (mOverlay)
        mOverlay->clearPicture();
}

void LampTool::setLit(bool lit)
{
    if (mPanel)
        mPanel->setLit(lit);
}

void LampTool::setUnlitLayers(const FrameExport& below, const FrameExport& above)
{
    if (mOverlay)
        mOverlay->setUnlitLayers(below, above);
}

void LampTool::setOverlaps(int frame, const QVector<Overlap>& overlaps)
{
    if (mCuts)
        mCuts->setOverlaps(frame, overlaps);
}

QVector<Cut> LampTool::cuts() const
{
    return mCuts && mCuts->isListening() ? mCuts->cuts() : QVector<Cut>();
}

void LampTool::setPalette(const QVector<Swatch>& swatches)
{
    mColours.setSwatches(swatches);
    if (mMaterials)
        mMaterials->setPalette(swatches);
    QStringList colours;
    for (const Swatch& swatch : swatches)
        colours << swatch.colour;
    if (auto* links = mPanel ? mPanel->findChild<LightLinks*>() : nullptr)
        links->setColours(colours);
}

void LampTool::setProgress(const QString& doing, int done, int total)
{
    for (QAction* action : {mSurfaces, mRender})
        action->setEnabled(total == 0);
    mCancel->setEnabled(total > 0);
    if (mPanel)
        mPanel->progress()->setProgress(doing, done, total);
    if (mProgress)
        mProgress->setProgress(doing, done, total);
    updateProgress();
}

void LampTool::setOutdated(int outdated, int total)
{
    if (mPanel)
        mPanel->render()->setOutdated(outdated, total);
}

void LampTool::updateProgress()
{
    // Cancel must be in sight, but not twice.
    if (mProgress)
        mProgress->setVisible(mProgress->isRunning() && !(mPanel && mPanel->isVisible()));
}

void LampTool::showProblem(const UserError& error)
{
    // A blank frame is no problem while another one is looked at.
    if (error.kind == UserError::Kind::NothingDrawn && error.frame != 0 &&
        error.frame != mHost.currentFrame())
        return;
    if (mPanel)
        mPanel->showProblem(error);
    mHost.showStatus(error.what, ProblemMs);
}

void LampTool::settleProblem(UserError::Kind kind)
{
    if (mPanel)
        mPanel->settleProblem(kind);
}

void LampTool::highlightColourAt(const QPointF& canvas)
{
    if (mMaterials)
        mMaterials->setHighlighted(mColours.at(canvas));
}

} // namespace lampblack
