#include "tool/depth/cut_menu.h"

#include "tool/canvas/lamp_menu.h"
#include "tool/depth/colour_depth.h"
#include "tool/depth/hint_edit.h"
#include "tool/depth/stroke_edit.h"

#include <algorithm>

namespace lampblack
{

CutMenu::CutMenu(Host& host, SceneDocument& document, CutEditor& editor, QWidget* parent)
    : QMenu(parent), mHost(host), mDocument(document), mEditor(editor)
{
    setObjectName(QStringLiteral("lampblack.cut_menu"));
}

void CutMenu::openAt(const Cut* cut, const QPoint& global, const QString& colour)
{
    clear();
    if (cut != nullptr)
        fillCut(*cut);
    fillColour(colour);
    fillFrame();
    popup(global);
}

void CutMenu::openAtStroke(int stroke, const QPoint& global, const QString& colour)
{
    clear();
    if (stroke >= 0)
    {
        addEntry("remove_stroke", tr("Remove Stroke"),
                 [this, stroke]
                 { mDocument.edit(tr("Remove Stroke"), withoutStroke(mDocument.scene(), stroke)); });
        addSeparator();
    }
    fillColour(colour);
    const QVector<DepthStroke>& strokes = mDocument.scene().depth.strokes;
    const int frame = mHost.currentFrame();
    const bool isBrushed = std::any_of(strokes.begin(), strokes.end(),
                                       [frame](const DepthStroke& one) { return one.frame == frame; });
    addEntry("remove_strokes_here", tr("Remove Strokes of Frame %1").arg(frame),
             [this, frame]
             { mDocument.edit(tr("Remove Strokes"), withoutStrokes(mDocument.scene(), frame)); })
        ->setEnabled(isBrushed);
    addEntry("remove_strokes", tr("Remove Strokes of All Frames"),
             [this] { mDocument.edit(tr("Remove Strokes"), withoutStrokes(mDocument.scene())); })
        ->setEnabled(!strokes.isEmpty());
    addLight();
    popup(global);
}

QAction* CutMenu::addEntry(const char* name, const QString& text, const std::function<void()>& onTriggered)
{
    QAction* action = addAction(text);
    action->setObjectName(QStringLiteral("lampblack.cut_menu.") + QLatin1String(name));
    connect(action, &QAction::triggered, this, [onTriggered] { onTriggered(); });
    return action;
}

void CutMenu::fillCut(const Cut& cut)
{
    const bool isJoined = cut.front == FrontSide::Joined;
    addEntry("other_side", isJoined ? tr("Open the Step") : tr("Other Side in Front"),
             [this, cut] { mEditor.bringOtherSideInFront(cut); });
    addEntry("join", tr("Joined: No Step"), [this, cut] { mEditor.join(cut); })->setEnabled(!isJoined);
    addEntry("apart", tr("Further Apart"), [this, cut] { mEditor.moveApart(cut); })->setEnabled(!isJoined);
    addEntry("together", tr("Nearer Together"), [this, cut] { mEditor.moveTogether(cut); })
        ->setEnabled(!isJoined);
    if (cut.hint >= 0)
        addEntry("remove", tr("Remove Correction"), [this, cut] { mEditor.removeCorrection(cut); });
    addSeparator();
}

void CutMenu::fillColour(const QString& colour)
{
    if (colour.isEmpty())
        return;
    constexpr int IconSide = 14;
    QAction* heading = addAction(colourIcon(QColor(colour), IconSide, devicePixelRatioF()), colour);
    heading->setEnabled(false);
    const DepthColour said = depthOf(mDocument.scene(), QColor(colour));
    const auto entry = [this, &said](const char* name, const QString& text, const DepthColour& changed)
    {
        addEntry(name, text,
                 [this, text, changed] { mDocument.edit(text, withDepthOf(mDocument.scene(), changed)); })
            ->setEnabled(!(changed == said));
    };
    entry("rounder", tr("Rounder"), rounder(said));
    entry("flatter", tr("Flatter"), flatter(said));
    entry("nearer", tr("Nearer"), nearer(said));
    entry("farther", tr("Farther"), farther(said));
    DepthColour asFound = said;
    asFound.volume = 1;
    asFound.nearer = 0;
    entry("as_found", tr("As Found"), asFound);
    addSeparator();
}

void CutMenu::fillFrame()
{
    const QVector<DepthHint>& hints = mDocument.scene().depth.hints;
    const int frame = mHost.currentFrame();
    const bool isCorrected = std::any_of(hints.begin(), hints.end(),
                                         [frame](const DepthHint& hint) { return hint.frame == frame; });
    addEntry("remove_here", tr("Remove Corrections of Frame %1").arg(frame),
             [this, frame]
             { mDocument.edit(tr("Remove Corrections"), withoutHints(mDocument.scene(), frame)); })
        ->setEnabled(isCorrected);
    addEntry("remove_all", tr("Remove Corrections of All Frames"),
             [this] { mDocument.edit(tr("Remove Corrections"), withoutHints(mDocument.scene())); })
        ->setEnabled(!hints.isEmpty());
    addLight();
}

void CutMenu::addLight()
{
    addSeparator();
    addEntry("light", tr("Back to the Light"), [this] { Q_EMIT lightRequested(); });
}

} // namespace lampblack
