#include "tool/depth/cut_editor.h"

#include "tool/depth/hint_edit.h"

#include <QLineF>

namespace lampblack
{

namespace
{

// Widget pixels.
constexpr double MouseReach = 8;
constexpr double PenReach = 12;
constexpr double StrokeThreshold = 5; // less is a click
constexpr double PointSpacing = 3;
constexpr double LeastStroke = 16;

} // namespace

CutEditor::CutEditor(Host& host, SceneDocument& document, CanvasOverlay& overlay)
    : PointerFilter(host, &overlay), mDocument(document), mOverlay(overlay)
{
    connect(&document, &SceneDocument::sceneChanged, this, &CutEditor::refresh);
    connect(&host, &Host::frameChanged, this,
            [this]
            {
                cancelStroke();
                refresh();
            });
}

void CutEditor::setOverlaps(int frame, const QVector<Overlap>& overlaps)
{
    mOverlapsFrame = frame;
    mOverlaps = overlaps;
    refresh();
}

const Cut* CutEditor::hovered() const
{
    return mHovered >= 0 && mHovered < mCuts.size() ? &mCuts[mHovered] : nullptr;
}

void CutEditor::cancelStroke()
{
    mStroke.clear();
    mIsPressed = false;
    mOverlay.setCutStroke({});
}

void CutEditor::refresh()
{
    if (!isListening())
        return;
    const int frame = host().currentFrame();
    mCuts = cutsAt(mDocument.scene(), frame, frame == mOverlapsFrame ? mOverlaps : QVector<Overlap>());
    mOverlay.setCuts(mCuts);
    setHovered(mPointer && !isDrawing() ? cutAt(*mPointer) : -1);
}

void CutEditor::handleListening()
{
    cancelStroke();
    mSwallowRelease = false;
    mStatus.clear();
    mOverlay.setCutsShown(isListening());
    if (isListening())
    {
        refresh();
        showCursor(Qt::CrossCursor);
    }
    else
    {
        mPointer.reset();
        setHovered(-1);
    }
}

void CutEditor::handleLeave()
{
    mPointer.reset();
    if (!mIsPressed)
        setHovered(-1);
}

bool CutEditor::handlePress(const Pointer& pointer)
{
    if (!mOverlay.canvasToWidget() || mIsPressed)
        return mIsPressed;
    setHovered(cutAt(pointer));
    if (pointer.button == Qt::RightButton)
    {
        mSwallowRelease = true;
        Q_EMIT menuRequested(hovered(), pointer.global);
        return true;
    }
    if (pointer.button != Qt::LeftButton)
        return false;
    host().canvas()->setFocus(Qt::MouseFocusReason);
    mIsPressed = true;
    mPressPosition = pointer.position;
    return true;
}

bool CutEditor::handleMove(const Pointer& pointer)
{
    if (!mOverlay.canvasToWidget())
        return false;
    if (!mIsPressed)
    {
        if (pointer.buttons != Qt::NoButton)
            return mSwallowRelease;
        mPointer = pointer;
        setHovered(cutAt(pointer));
        return false;
    }
    if (mStroke.isEmpty())
    {
        if (QLineF(mPressPosition, pointer.position).length() < StrokeThreshold)
            return true;
        setHovered(-1);
        mStroke.append(toCanvas(mPressPosition));
    }
    const QPointF last = mOverlay.canvasToWidget()->map(mStroke.last());
    if (QLineF(last, pointer.position).length() >= PointSpacing)
    {
        mStroke.append(toCanvas(pointer.position));
        mOverlay.setCutStroke(mStroke);
    }
    return true;
}

bool CutEditor::handleRelease(const Pointer& pointer)
{
    if (mIsPressed && pointer.button == Qt::LeftButton)
    {
        if (isDrawing())
            addStroke();
        else if (const Cut* cut = hovered())
            bringOtherSideInFront(*cut);
        cancelStroke();
        mPointer = pointer;
        setHovered(cutAt(pointer));
        return true;
    }
    const bool isOurs = mIsPressed || mSwallowRelease;
    mSwallowRelease = false;
    return isOurs;
}

void CutEditor::addStroke()
{
    if (lengthOf(mOverlay.canvasToWidget()->map(mStroke)) < LeastStroke)
        return;
    const Cut drawn{mStroke, FrontSide::Left, 0, true, -1};
    edit(tr("Draw a Step"), withFront(mDocument.scene(), host().currentFrame(), drawn, drawn.front), drawn);
}

void CutEditor::bringOtherSideInFront(const Cut& cut)
{
    edit(tr("Other Side in Front"),
         withFront(mDocument.scene(), host().currentFrame(), cut, otherSide(cut.front)), cut);
}

void CutEditor::join(const Cut& cut)
{
    edit(tr("Join"), withFront(mDocument.scene(), host().currentFrame(), cut, FrontSide::Joined), cut);
}

void CutEditor::moveApart(const Cut& cut)
{
    const double amount = furtherApart(mDocument.scene(), cut, characterSide());
    edit(tr("Further Apart"), withAmount(mDocument.scene(), host().currentFrame(), cut, amount), cut);
}

void CutEditor::moveTogether(const Cut& cut)
{
    const double amount = nearerTogether(mDocument.scene(), cut, characterSide());
    edit(tr("Nearer Together"), withAmount(mDocument.scene(), host().currentFrame(), cut, amount), cut);
}

void CutEditor::removeCorrection(const Cut& cut)
{
    edit(tr("Remove Correction"), withoutHint(mDocument.scene(), cut), cut);
}

void CutEditor::edit(const QString& text, const Scene& scene, const Cut& cut)
{
    if (!canCorrect(mDocument.scene(), cut))
    {
        host().showStatus(
            tr("A project has at most %1 corrections of depth. Remove some first.").arg(MaxHints));
        return;
    }
    // `cut` may be one of mCuts, which the edit replaces.
    mDocument.edit(text, scene);
}

void CutEditor::setHovered(int cut)
{
    mHovered = cut;
    mOverlay.setHoveredCut(cut);
    if (!isListening())
        return;
    const Cut* found = hovered();
    showCursor(found != nullptr ? Qt::PointingHandCursor : Qt::CrossCursor);
    QString status = tr("Drag where a step is missing: the left side comes in front");
    if (found != nullptr && found->front == FrontSide::Joined)
        status = tr("Joined by you. Click: open it again. Right-click: more");
    else if (found != nullptr)
        status = tr("The side with teeth is in front. Click: the other side. Right-click: more");
    if (status != mStatus)
        host().showStatus(status);
    mStatus = status;
}

int CutEditor::cutAt(const Pointer& pointer) const
{
    if (!mOverlay.canvasToWidget())
        return -1;
    return cutUnder(mCuts, *mOverlay.canvasToWidget(), pointer.position,
                    pointer.isPen ? PenReach : MouseReach);
}

double CutEditor::characterSide() const
{
    if (mDrawing.image.isNull())
        return 0;
    const double scale = scaleOf(mDrawing.canvasToImage);
    return scale > 0 ? longerSideOf(mDrawing.image) / scale : 0;
}

QPointF CutEditor::toCanvas(const QPointF& position) const
{
    return mOverlay.canvasToWidget()->inverted().map(position);
}

} // namespace lampblack
