#include "tool/lamp_tool.h"

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
      mActions(host), mCanvas(host, document, mColours)
{
    initIcons();
    addTool();
    addPanel();
    addDock();
    setUpActions();
    setUpCanvas();
    connect(&worker, &Worker::problem, this, &LampTool::showProblem);
    connect(&worker, &Worker::stateChanged, this,
            [this](Worker::State state)
            {
                if (state == Worker::State::Ready || state == Worker::State::Busy)
                    mMissing.clear();
                updateMaterialsHint();
            });
    connect(&host, &Host::problem, this, &LampTool::showProblem);
    connect(&host, &Host::frameExported, this, [this] { settleProblem(UserError::Kind::NotRead); });
    connect(&document, &SceneDocument::problem, this, &LampTool::showProblem);
    connect(&host, &Host::toolActivated, this, &LampTool::setActive);
    connect(&host, &Host::projectOpened, this,
            [this]
            {
                mWasActive = mActive; // another project is drawn in the light only once it was lit
                updateOverlay();
                setPalette({}); // its colours were those of the project before
                settleProblem(UserError::Kind::NothingDrawn);
                settleProblem(UserError::Kind::NotRead);
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
    delete mMaterials;
    delete mPanel;
}

void LampTool::setUpActions()
{
    connect(mActions.keep(), &QAction::toggled, this, &LampTool::updateOverlay);
    connect(mActions.surfaces(), &QAction::triggered, this, &LampTool::generateSurfacesRequested);
    connect(mActions.render(), &QAction::triggered, this, &LampTool::renderAllRequested);
    connect(&mActions, &LightActions::cancelRequested, this, &LampTool::cancelRequested);
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
    mPanel = new LampPanel(mHost, mDocument, *mActions.surfaces(), *mActions.render());
    connect(mPanel, &LampPanel::viewModeChanged, this, &LampTool::setViewMode);
    connect(mPanel->render(), &RenderSection::renderChangedRequested, this,
            &LampTool::renderChangedRequested);
    connect(mPanel->progress(), &JobProgress::cancelRequested, this, &LampTool::cancelRequested);
    connect(&mWorker, &Worker::stateChanged, mPanel.data(), &LampPanel::setWorkerState);
    connect(mPanel, &LampPanel::retryRequested, &mWorker, &Worker::start);
    connect(&mWorker, &Worker::cardFound, mPanel->device(), &DeviceRow::setCard);
    connect(mPanel->device(), &DeviceRow::chosen, &mWorker, &Worker::setDevice);
    connect(mPanel->device(), &DeviceRow::computerChosen, &mWorker,
            [this](const std::optional<Computer>& computer)
            {
                mWorker.setComputer(computer);
                if (mActive)
                    mWorker.start();
            });
    mWorker.setDevice(mPanel->device()->device());
    mWorker.setComputer(mPanel->device()->computer());
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
                mCanvas.setPicking(picking && mActive);
                if (picking && mMaterials)
                    mMaterials->setPicking(mCanvas.isPicking());
            });
    updateMaterialsHint();
    mHost.addDock(mMaterials);
}

void LampTool::updateMaterialsHint()
{
    if (!mMaterials)
        return;
    if (!mMissing.isEmpty())
        mMaterials->setHint(mMissing);
    else if (mActive)
        mMaterials->setHint(tr("The colours of the drawing appear here when it is lit."));
    else
        mMaterials->setHint(tr("Choose the lamp to see the colours of the drawing here."));
}

void LampTool::setUpCanvas()
{
    MaterialsDock* materials = mMaterials;
    connect(&mCanvas, &CanvasTools::colourHovered, materials, &MaterialsDock::setHighlighted);
    connect(&mCanvas, &CanvasTools::colourPicked, materials, &MaterialsDock::revealColour);
    connect(&mCanvas, &CanvasTools::materialRequested, materials, &MaterialsDock::revealColour);
    connect(&mCanvas, &CanvasTools::pickingChanged, materials, &MaterialsDock::setPicking);
    connect(&mCanvas, &CanvasTools::viewRequested, this, [this](Show view) { setViewMode(view); });
}

void LampTool::updateInput()
{
    mHost.showStatus(mActive ? mTool->statusTip() : QString());
    mCanvas.setListening(mActive, showsDepth());
}

void LampTool::setActive(bool active)
{
    if (active == mActive)
        return;
    mActive = active;
    mWasActive = true;
    updateOverlay();
    updateInput();
    updateMaterialsHint();
    updateProgress();
    Q_EMIT activeChanged(active);
}

bool LampTool::isDrawing() const
{
    return !mActive && mWasActive && mActions.keep()->isChecked() && viewMode() == Show::Lit;
}

void LampTool::updateOverlay()
{
    if (CanvasOverlay* overlay = mCanvas.overlay())
    {
        overlay->setDrawing(isDrawing());
        overlay->setVisible(isLighting());
        overlay->raise();
        overlay->updateHandles();
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
    clearPicture();
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
    mCanvas.setFrame(frame);
    if (frame.canvasToImage.isIdentity())
        mCameras.remove(frame.frame);
    else
        mCameras.insert(frame.frame, frame.canvasToImage);
}

void LampTool::setPicture(const PreviewImage& picture)
{
    CanvasOverlay* overlay = mCanvas.overlay();
    if (overlay == nullptr || (!picture.picture.isNull() && picture.show != viewMode()))
        return;
    overlay->setPicture(picture, mCameras.value(picture.frame));
}

void LampTool::setStandIn(const PreviewImage& picture, const QTransform& canvasToImage)
{
    if (CanvasOverlay* overlay = mCanvas.overlay())
        overlay->setStandIn(picture, canvasToImage);
}

void LampTool::setDrawn(const FrameExport& drawn)
{
    if (CanvasOverlay* overlay = mCanvas.overlay())
        overlay->setDrawn(drawn);
}

void LampTool::clearPicture()
{
    if (CanvasOverlay* overlay = mCanvas.overlay())
        overlay->clearPicture();
}

void LampTool::setLit(bool lit)
{
    if (mPanel)
        mPanel->setLit(lit);
}

void LampTool::setUnlitLayers(const FrameExport& below, const FrameExport& above)
{
    if (CanvasOverlay* overlay = mCanvas.overlay())
        overlay->setUnlitLayers(below, above);
}

void LampTool::setOverlaps(int frame, const QVector<Overlap>& overlaps)
{
    mCanvas.setOverlaps(frame, overlaps);
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
    if (mPanel)
        mPanel->progress()->setProgress(doing, done, total);
    mActions.setProgress(doing, done, total);
    updateProgress();
}

void LampTool::setOutdated(int outdated, int total)
{
    if (mPanel)
        mPanel->render()->setOutdated(outdated, total);
}

void LampTool::updateProgress()
{
    mActions.setSeenElsewhere(mPanel && mPanel->isVisible());
}

void LampTool::showProblem(const UserError& error)
{
    // A blank frame is no problem while another one is looked at.
    if (error.kind == UserError::Kind::NothingDrawn && error.frame != 0 &&
        error.frame != mHost.currentFrame())
        return;
    if (error.kind == UserError::Kind::NoWorker || error.kind == UserError::Kind::NoOtherComputer)
        mMissing = error.what + QLatin1Char(' ') + error.remedy;
    updateMaterialsHint();
    if (mPanel)
        mPanel->showProblem(error);
    mHost.showStatus(error.what, ProblemMs);
}

void LampTool::settleProblem(UserError::Kind kind)
{
    if (mPanel)
        mPanel->settleProblem(kind);
}

} // namespace lampblack
