#include "host/tool_palette.h"

#include <QActionGroup>
#include <QGuiApplication>
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
    leave();
    delete mButton;
}

void ToolPalette::add(QAction* tool)
{
    const QVector<QToolButton*> tools = mParts.toolButtons();
    if (mAction != nullptr || tools.isEmpty())
        return;
    mAction = tool;
    const QToolButton* neighbour = tools.last();
    auto* layout = neighbour->parentWidget()->layout();
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
    layout->addWidget(mButton);
    mButton->show();

    connect(tool, &QAction::toggled, this, &ToolPalette::onToggled);
    // A second press of the tool in use keeps it, as with the others.
    (new QActionGroup(this))->addAction(tool);
    connect(mParts.tools, SIGNAL(toolChanged(ToolType)), this, SLOT(onToolChanged()));
    for (QToolButton* other : tools)
        connect(other, &QToolButton::clicked, this, &ToolPalette::leave);

    auto* menu = mParts.window->findChild<QMenu*>(QStringLiteral("menuTools"));
    if (menu == nullptr)
    {
        mParts.window->addAction(tool);
        return;
    }
    const QList<QAction*> entries = menu->actions();
    for (QAction* other : entries)
        connect(other, &QAction::triggered, this, &ToolPalette::leave);
    const auto separator = std::find_if(entries.begin(), entries.end(),
                                        [](const QAction* entry) { return entry->isSeparator(); });
    menu->insertAction(separator == entries.end() ? nullptr : *separator, tool);
}

void ToolPalette::onToggled(bool checked)
{
    if (checked)
        enter();
    else if (mBefore != nullptr)
    {
        const QVector<QToolButton*> tools = mParts.toolButtons();
        const bool other = std::any_of(tools.begin(), tools.end(),
                                       [this](const QToolButton* button)
                                       { return button != mButton && button->isChecked(); });
        if (!other)
            mBefore->setChecked(true);
        mBefore = nullptr;
    }
    Q_EMIT activated(checked);
}

void ToolPalette::enter()
{
    const QVector<QToolButton*> tools = mParts.toolButtons();
    for (QToolButton* button : tools)
    {
        if (button == mButton || !button->isChecked())
            continue;
        mBefore = button;
        button->setChecked(false);
    }
}

void ToolPalette::onToolChanged()
{
    if (mAction == nullptr || !mAction->isChecked())
        return;
    // Alt takes the eyedropper, for one, and gives the tool back on release: no choice of the artist's.
    const bool held = QGuiApplication::queryKeyboardModifiers() != Qt::NoModifier;
    if (!held && !mBorrowed)
    {
        leave();
        return;
    }
    mBorrowed = held;
    enter();
}

void ToolPalette::leave()
{
    mBorrowed = false;
    if (mAction != nullptr)
        mAction->setChecked(false);
}

} // namespace lampblack
