// Our tool among the program's: a button in the palette and an entry in the menu of tools, exclusive with
// theirs.
#pragma once

#include "host/parts.h"

namespace lampblack
{

class ToolPalette : public QObject
{
    Q_OBJECT

public:
    ToolPalette(const Parts& parts, QObject* parent);
    ~ToolPalette() override;

    /// Without a palette that is known, the tool is in the menu only.
    void add(QAction* tool);

    /// Do `work` with the program's own tool of this action in use, and take the tool before again. Ours
    /// stays in use if it was. Nothing is done, and false returned, if the tool before is not known.
    bool workWith(QAction* tool, const std::function<void()>& work);

Q_SIGNALS:
    void activated(bool active);

private Q_SLOTS:
    void uncheckOthers();

private:
    void deactivate();
    void addButton(QAction* tool);
    void addToMenu(QAction* tool);
    void onToggled(bool checked);
    QToolButton* checkedOther() const;

    Parts mParts;
    QPointer<QAction> mAction;
    QPointer<QToolButton> mButton;
    QPointer<QToolButton> mBefore; ///< the tool that was active before ours
    bool mWorking = false;
};

} // namespace lampblack
