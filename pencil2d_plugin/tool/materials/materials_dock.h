// The dock of flat colours and what each wears.
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

/// Colours of the frame in sight, most used first; below, folded, colours that have a material but are
/// not in it.
class MaterialsDock : public QDockWidget
{
    Q_OBJECT

public:
    explicit MaterialsDock(SceneDocument& document);

    void setPalette(const QVector<Swatch>& swatches);
    /// Mark the colour under the pointer; empty for none.
    void setHighlighted(const QString& colour);
    /// Bring the dock and the row of a colour into sight and mark it.
    void reveal(const QString& colour);
    void setPicking(bool picking) { mPick->setChecked(picking); }

Q_SIGNALS:
    void pickRequested(bool picking);

private:
    void refresh();
    void arrange();
    QVector<QString> elsewhere() const;
    SwatchRow* row(const QString& colour);

    SceneDocument& mDocument;
    QVector<QString> mPalette;
    QVector<QString> mOthers;
    QMap<QString, SwatchRow*> mRows;
    QString mHighlighted;
    int mColumnWidth = 0; ///< of the boxes
    QToolButton* mPick;
    QLabel* mEmpty;
    QScrollArea* mScroll;
    QVBoxLayout* mInFrame;
    Section* mElsewhere;
};

} // namespace lampblack
