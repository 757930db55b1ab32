// Our button among the program's tools, exclusive with them.
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

    void add(QAction* tool);

Q_SIGNALS:
    void activated(bool active);

private Q_SLOTS:
    void onToolChanged();

private:
    void leave();
    void onToggled(bool checked);
    void enter();

    Parts mParts;
    QPointer<QAction> mAction;
    QPointer<QToolButton> mButton;
    QPointer<QToolButton> mBefore; ///< the program's tool that ours stands in for
    bool mBorrowed = false;        ///< the program changed its tool for as long as a key is held
};

} // namespace lampblack
