#include "host/tool_palette.h"

#include <QActionGroup>
#include <QButtonGroup>
#include <QLayout>
#include <QMenu>

#include <algorithm>

namespace lampblack
{

ToolPalette::ToolPalette(const Parts& parts, QObject* parent) : QObject(parent), mParts(parts)
{
}

ToolPalette::~ToolPalette()
{
    deactivate();
    delete mButton;
}

void ToolPalette::add(QAction* tool)
{
    if (mAction != nullptr)
        return;
    mAction = tool;
    connect(tool, &QAction::toggled, this, &ToolPalette::onToggled);
    // In an exclusive group, clicking the active tool again keeps it, as with the other tools.
    (new QActionGroup(this))->addAction(tool);
    // The program changes its tool on its own too: while Alt, the space bar or the middle button is held.
    // Since 0.7 it announces its tool again whenever a key is released, and it may check the button of that
    // tool.
    if (has(mParts.tools, "toolChanged(ToolType)"))
        connect(mParts.tools, SIGNAL(toolChanged(ToolType)), this, SLOT(uncheckOthers()));
    addButton(tool);
    addToMenu(tool);
}

void ToolPalette::addButton(QAction* tool)
{
    const QVector<QToolButton*> tools = mParts.toolButtons();
    if (tools.isEmpty() || tools.last()->parentWidget()->layout() == nullptr)
        return;
    const QToolButton* neighbour = tools.last();
    mButton = new QToolButton(neighbour->parentWidget());
    mButton->setObjectName(QStringLiteral("lampblackButton"));
    mButton->setDefaultAction(tool);
    mButton->setToolButtonStyle(Qt::ToolButtonIconOnly);
    mButton->setIconSize(neighbour->iconSize());
    mButton->setMinimumSize(neighbour->minimumSize());
    mButton->setMaximumSize(neighbour->maximumSize());
    mButton->setSizePolicy(neighbour->sizePolicy());
    mButton->setAutoRaise(neighbour->autoRaise());
    mButton->setFocusPolicy(neighbour->focusPolicy());
    mButton->setStyleSheet(neighbour->styleSheet());
    neighbour->parentWidget()->layout()->addWidget(mButton);
    mButton->show();
    for (QToolButton* other : tools)
        connect(other, &QToolButton::clicked, this, &ToolPalette::deactivate);
}

void ToolPalette::addToMenu(QAction* tool)
{
    auto* menu = mParts.window->findChild<QMenu*>(QStringLiteral("menuTools"));
    if (menu == nullptr)
    {
        mParts.window->addAction(tool);
        return;
    }
    const QList<QAction*> entries = menu->actions();
    for (QAction* other : entries)
        connect(other, &QAction::triggered, this, &ToolPalette::deactivate);
    const auto separator = std::find_if(entries.begin(), entries.end(),
                                        [](const QAction* entry) { return entry->isSeparator(); });
    menu->insertAction(separator == entries.end() ? nullptr : *separator, tool);
}

bool ToolPalette::workWith(QAction* tool, const std::function<void()>& work)
{
    const QPointer<QToolButton> before = checkedOther() != nullptr ? checkedOther() : mBefore.data();
    if (before == nullptr || tool == nullptr)
        return false;
    mWorking = true;
    tool->trigger();
    work();
    if (before != nullptr)
        before->click();
    mWorking = false;
    uncheckOthers();
    return true;
}

QToolButton* ToolPalette::checkedOther() const
{
    const QVector<QToolButton*> tools = mParts.toolButtons();
    const auto checked =
        std::find_if(tools.begin(), tools.end(),
                     [this](const QToolButton* button) { return button != mButton && button->isChecked(); });
    return checked == tools.end() ? nullptr : *checked;
}

void ToolPalette::onToggled(bool checked)
{
    if (checked)
        uncheckOthers();
    else if (mBefore != nullptr && checkedOther() == nullptr)
        mBefore->setChecked(true);
    Q_EMIT activated(checked);
}

void ToolPalette::uncheckOthers()
{
    if (mAction == nullptr || !mAction->isChecked())
        return;
    const QVector<QToolButton*> tools = mParts.toolButtons();
    for (QToolButton* button : tools)
    {
        if (button == mButton || !button->isChecked())
            continue;
        mBefore = button;
        // An exclusive group, which 0.7.2 has, always keeps one button checked.
        QButtonGroup* group = button->group();
        const bool isExclusive = group != nullptr && group->exclusive();
        if (isExclusive)
            group->setExclusive(false);
        button->setChecked(false);
        if (isExclusive)
            group->setExclusive(true);
    }
}

void ToolPalette::deactivate()
{
    if (mAction != nullptr && !mWorking)
        mAction->setChecked(false);
}

} // namespace lampblack
