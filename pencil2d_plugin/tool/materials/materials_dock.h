// The dock with the materials of the flat colours.
#pragma once

#include "scene/scene_document.h"
#include "tool/materials/swatch_row.h"
#include "tool/panel/section.h"
#include "worker/worker.h"

#include <QDockWidget>
#include <QLabel>
#include <QScrollArea>

namespace lampblack
{

/// Lists the colours of the current frame, most used first. A folded section below lists other colours that
/// have a material.
class MaterialsDock : public QDockWidget
{
    Q_OBJECT

public:
    explicit MaterialsDock(SceneDocument& document);

    void setPalette(const QVector<Swatch>& swatches);
    /// What is said while there are no colours.
    void setHint(const QString& hint) { mEmptyLabel->setText(hint); }
    /// Mark the row of a colour; empty for none.
    void setHighlighted(const QString& colour);
    /// Show the dock, scroll to the row of a colour and mark it.
    void revealColour(const QString& colour);
    void setPicking(bool picking) { mPick->setChecked(picking); }

Q_SIGNALS:
    void pickRequested(bool picking);

private:
    void refresh();
    void updateRows();
    QVector<QString> otherColours() const;
    SwatchRow* rowFor(const QString& colour);

    SceneDocument& mDocument;
    QVector<QString> mPalette;
    QVector<QString> mOtherColours;
    QMap<QString, SwatchRow*> mRows;
    QString mHighlighted;
    int mColumnWidth = 0; ///< width of the columns of check boxes
    QToolButton* mPick;
    QLabel* mEmptyLabel;
    QScrollArea* mScroll;
    QVBoxLayout* mFrameRows;
    Section* mOtherSection;
};

} // namespace lampblack
