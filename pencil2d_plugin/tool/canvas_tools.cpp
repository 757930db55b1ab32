#include "tool/canvas_tools.h"

#include "tool/canvas/canvas_input.h"
#include "tool/canvas/key_input.h"
#include "tool/canvas/lamp_menu.h"
#include "tool/depth/brush_bar.h"
#include "tool/depth/brush_editor.h"
#include "tool/depth/cut_editor.h"
#include "tool/depth/cut_menu.h"

namespace lampblack
{

CanvasTools::CanvasTools(Host& host, SceneDocument& document, const FrameColours& colours, QObject* parent)
    : QObject(parent), mHost(host), mColours(colours)
{
    if (host.canvas() == nullptr)
        return;
    mOverlay = new CanvasOverlay(host, document);
    mInput = new CanvasInput(host, document, *mOverlay);
    mCuts = new CutEditor(host, document, *mOverlay);
    mBrush = new BrushEditor(host, document, *mOverlay);
    mKeys = new KeyInput(host, document, *mOverlay, *mInput, mCuts, mBrush);
    mMenu = new LampMenu(host, document, host.canvas());
    mCutMenu = new CutMenu(host, document, *mCuts, host.canvas());
    mBrushBar = new BrushBar(host.canvas());
    connect(&host, &Host::playingChanged, mOverlay.data(), &CanvasOverlay::setPlaying);
    setUpLights();
    setUpDepth();
}

CanvasTools::~CanvasTools()
{
    delete mBrushBar;
    delete mOverlay; // deletes the event filters of the canvas too
    delete mMenu;
    delete mCutMenu;
}

void CanvasTools::setUpLights()
{
    connect(mInput, &CanvasInput::menuRequested, mMenu.data(),
            [this](const QPointF& canvas, const QPoint& global, const Handle& handle)
            { mMenu->openAt(canvas, global, handle, mColours.at(canvas)); });
    connect(mInput, &CanvasInput::pointerMoved, this,
            [this](const QPointF& canvas) { Q_EMIT colourHovered(mColours.at(canvas)); });
    connect(mInput, &CanvasInput::pointerLeft, this, [this] { Q_EMIT colourHovered(QString()); });
    connect(mInput, &CanvasInput::colourPicked, this,
            [this](const QPointF& canvas) { Q_EMIT colourPicked(mColours.at(canvas)); });
    connect(mInput, &CanvasInput::pickingChanged, this, &CanvasTools::pickingChanged);
    connect(mMenu, &LampMenu::editMaterialRequested, this, &CanvasTools::materialRequested);
    connect(mMenu, &LampMenu::depthRequested, this, [this] { Q_EMIT viewRequested(Show::Relief); });
}

void CanvasTools::setUpDepth()
{
    connect(mCuts, &CutEditor::menuRequested, mCutMenu.data(),
            [this](const Cut* cut, const QPoint& global)
            { mCutMenu->openAt(cut, global, colourAt(global)); });
    connect(mBrush, &BrushEditor::menuRequested, mCutMenu.data(),
            [this](int stroke, const QPoint& global)
            { mCutMenu->openAtStroke(stroke, global, colourAt(global)); });
    connect(mBrushBar, &BrushBar::brushChosen, this,
            [this](std::optional<Brush> brush)
            {
                if (brush)
                    mBrush->setBrush(*brush);
                listen();
            });
    connect(mCutMenu, &CutMenu::lightRequested, this, [this] { Q_EMIT viewRequested(Show::Lit); });
}

QString CanvasTools::colourAt(const QPoint& global) const
{
    const std::optional<QTransform> toWidget = mHost.canvasToWidget();
    if (!toWidget || !toWidget->isInvertible())
        return {};
    return mColours.at(toWidget->inverted().map(QPointF(mHost.canvas()->mapFromGlobal(global))));
}

void CanvasTools::setListening(bool listening, bool depth)
{
    mListening = listening;
    mDepth = depth;
    listen();
}

void CanvasTools::listen()
{
    if (!mOverlay)
        return;
    mKeys->setListening(mListening);
    const bool depth = mListening && mDepth;
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
    mInput->setListening(mListening && !depth);
}

void CanvasTools::setPicking(bool picking)
{
    if (mInput)
        mInput->setPicking(picking);
}

bool CanvasTools::isPicking() const
{
    return mInput && mInput->isPicking();
}

void CanvasTools::setFrame(const FrameExport& frame)
{
    if (mCuts)
        mCuts->setFrame(frame);
}

void CanvasTools::setOverlaps(int frame, const QVector<Overlap>& overlaps)
{
    if (mCuts)
        mCuts->setOverlaps(frame, overlaps);
}

QVector<Cut> CanvasTools::cuts() const
{
    return mCuts && mCuts->isListening() ? mCuts->cuts() : QVector<Cut>();
}

} // namespace lampblack
